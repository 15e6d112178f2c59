// SPDX-License-Identifier: MIT
// Section 5.2.7: the adaptive controller follows sines on the realistic arm.
#include "section.hpp"

#include <limpid/control/omni_safety.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/device/simulated_omni.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace limpid::examples {

namespace {

using Joints = Eigen::Vector3d;

// The sines of 5.2.7 about q(0), rad.
DesiredJoints<3> reference(double t, const Joints& q0) {
  using std::numbers::pi;
  const Eigen::Array3d amplitude{pi / 8, pi / 7, pi / 10}, omega{0.6 * pi, 0.4 * pi, 0.46 * pi};
  const Eigen::Array3d sine = (omega * t).sin(), cosine = (omega * t).cos();
  return {q0 + Joints(0, 0.1, 0) + (amplitude * cosine).matrix(), (-amplitude * omega * sine).matrix(),
          (-amplitude * omega * omega * cosine).matrix()};
}

SlotineLiAdaptive<Omni<>> tuned_controller() {
  Omni<>::Parameters Gamma;
  Gamma << 0.01, 0.002, 0.002, 0.0005, 0.001, 0.001, 0.02, 0.02, 0.02;
  return SlotineLiAdaptive<Omni<>>(
      {.Lambda = {2.8, 3.0, 1.5}, .Kd = {0.4, 0.28, 0.10}, .Gamma = Gamma, .theta0 = Omni<>::table_5_2()});
}

}  // namespace

SectionReport section_5_2_7() {
  SectionReport report{.title = "5.2.7 adaptive controller tuning, realistic arm"};
  constexpr Duration tick = std::chrono::milliseconds{1}, length = std::chrono::seconds{30};
  constexpr Duration settled = std::chrono::seconds{10};
  const Joints q0{0, std::numbers::pi / 4, -1.5};
  SimulatedOmni<> arm({.q0 = reference(0, q0).q, .realism = Realism::realistic});
  SlotineLiAdaptive<Omni<>> controller = tuned_controller();
  SafetyLimiter<Omni<>> limiter({.joint_margin = 0});

  std::array<Curve, 3> errors;
  Joints bound = Joints::Zero();
  Status seen = Status::ok;
  for (Time now{0}; now <= length; now += tick) {
    (void)arm.advance(now, Joints::Zero());
    const DeviceState<> measured = arm.read(now);
    const DesiredJoints<3> wanted = reference(in_seconds(now), q0);
    const auto [tau, status] = controller.update(now, measured.joint_state(), wanted, Joints::Zero());
    const auto safe = limiter.limit(now, measured.joint_state(), tau, measured.status | status);
    (void)arm.write(safe.torque);
    seen |= safe.status;
    const Joints error = arm.true_state().q - wanted.q;
    if (now >= settled) bound = bound.cwiseMax(error.cwiseAbs());
    for (std::size_t i = 0; i < 3; ++i) {
      errors[i].x.push_back(in_seconds(now));
      errors[i].y.push_back(error[static_cast<Eigen::Index>(i)]);
    }
  }

  constexpr std::array<double, 3> printed{0.035, 0.042, 0.136};
  Panel panel{"joint error", "time (s)", "rad", {}};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string joint = "joint " + std::to_string(i + 1);
    report.figures.push_back({joint + ": bound on the tracking error after 10 s", bound[static_cast<Eigen::Index>(i)],
                              printed[i], "rad", "printed: measured on hardware"});
    errors[i].name = joint;
    panel.curves.push_back(errors[i]);
  }
  report.charts.push_back(
      {"fig_5_6", {"Fig. 5.6: joint errors of the tuned controller (" + describe(seen) + ")", {panel}}});
  return report;
}

}  // namespace limpid::examples
