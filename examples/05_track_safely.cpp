// SPDX-License-Identifier: MIT
// A simulated arm that follows a circle; only what the limiter has seen reaches its motors.
#include <limpid/control/omni_safety.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/device/simulated_omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>

#include <cmath>
#include <cstdio>
#include <limits>

using namespace limpid;
using namespace std::chrono_literals;
using Point = Eigen::Vector3d;

int main() {
  SimulatedOmni<> device({.realism = Realism::ideal});
  SlotineLiAdaptive<Omni<>> controller({.Lambda = {2.8, 3.0, 1.5},
                                        .Kd = {0.4, 0.28, 0.1},
                                        .Gamma = Omni<>::Parameters::Constant(0.001),
                                        .theta0 = 1.1 * Omni<>::table_5_2()});
  SafetyLimiter<Omni<>> limiter({});
  const OmniKinematics<> kinematics{Omni<>{}};
  const Point centre = Omni<>{}.at(device.true_state().q).position() - Point(0.01, 0, 0);

  double error = 0;
  Point applied = Point::Zero();  // what the device had, so that the controller does not learn from the limiter's cuts
  for (Time now = 0ms; now <= 5s; now += 1ms) {
    const double angle = 2 * in_seconds(now), c = 0.01 * std::cos(angle), s = 0.01 * std::sin(angle);
    const auto wanted = kinematics.inverse(centre + Point(c, s, 0), Point(-2 * s, 2 * c, 0), Point(-4 * c, -4 * s, 0));
    (void)device.advance(now, Point::Zero());
    const DeviceState<> is = device.read(now);
    const auto [tau, status] = controller.update(now, is.joint_state(), wanted, Point::Zero(), applied);
    const auto safe = limiter.limit(now, is.joint_state(), tau, is.status | status | wanted.status);
    applied = safe.torque.value();
    (void)device.write(safe.torque);
    if (now > 2s) error = std::max(error, (is.q - wanted.q).norm());
  }
  std::printf("largest joint error after 2 s: %.4f rad\n", error);

  const Point broken = Point::Constant(std::numeric_limits<double>::quiet_NaN());
  const auto safe = limiter.limit(5001ms, device.read(5s).joint_state(), broken);
  std::printf("a torque that is not a number: %s, torque %.1f N m\n", describe(limiter.reason()).data(),
              safe.torque.value().norm());
  return error < 0.02 && safe.torque.value().isZero(0) ? 0 : 1;
}
