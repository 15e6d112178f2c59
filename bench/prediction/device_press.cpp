// SPDX-License-Identifier: MIT
#include "prediction/device_press.hpp"

#include "prediction/drive.hpp"
#include "prediction/judge.hpp"

#include <common/palpation_arm.hpp>

#include <limpid/control/compensated_tracking.hpp>
#include <limpid/evaluation/error_norms.hpp>
#include <limpid/robot/omni_kinematics.hpp>

namespace limpid::bench {

namespace {

using Arm = Omni<>;
using Tracking = SlotineLiAdaptive<Arm>;
using Eigen::Vector3d;

examples::Scene scene_of(Follower follower) {
  examples::Scene scene;
  scene.robot = follower == Follower::ideal ? examples::RobotKind::ideal : examples::RobotKind::realistic;
  return scene;
}

/// Factors on (5.6), (5.7).
Tracking::Settings scaled(Tracking::Settings settings, double Kd, double Lambda, double Gamma) {
  settings.Kd *= Kd;
  settings.Lambda *= Lambda;
  settings.Gamma *= Gamma;
  return settings;
}

CompensatedTracking<Arm>::Settings compensated(const Tracking::Settings& controller) {
  const Eigen::Array3d friction = Arm{}.limits().static_friction.array();
  return {.controller = controller,
          .observer = {.theta = Arm::table_5_2(), .bandwidth = 110},
          .friction = {.identifier = {.largest = 1.5 * friction, .start = friction},
                       .presliding = Eigen::Array3d::Constant(6.2e-4),
                       .share = 0.95}};
}

// How far each joint has moved.
class Range {
 public:
  void add(const Vector3d& q) {
    least_ = least_.cwiseMin(q);
    most_ = most_.cwiseMax(q);
  }
  [[nodiscard]] double widest() const { return (most_ - least_).maxCoeff(); }

 private:
  Vector3d least_ = Vector3d::Constant(1e9), most_ = -least_;
};

template <typename Controller>
Press press_with(Controller controller, const examples::Scene& scene, const Truth& truth, const Trace& wanted) {
  const Vector3d wall = examples::wall_of(scene);
  const OmniKinematics<> kinematics{Arm{}};
  SimulatedOmni<> arm = examples::make_device(scene);
  SafetyLimiter<Arm> limiter = examples::make_limiter(scene);
  ErrorNorms<3> total, late;
  Range range;
  Press made;
  Vector3d applied = Vector3d::Zero();
  const std::size_t count = truth.ticks.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Time now = time_of(k);
    const auto along = [](double x) { return Vector3d(x, 0, 0); };
    const Vector3d F_h = along(truth.ticks[k].F_h);
    (void)arm.advance(now, F_h);
    const auto measured = arm.read(now);
    const auto& [x, v, a] = wanted[k];
    const auto joints = kinematics.inverse(wall + along(x), along(v), along(a), measured.q);
    const auto is = measured.joint_state();
    const auto [torque, status] = limiter.limit(now, is, controller.update(now, is, joints, F_h, applied).tau);
    (void)arm.write(torque);
    made.status |= status;
    made.limited += has(status, Status::limited) ? 1.0 / static_cast<double>(count) : 0;
    made.chatter += (torque.value() - applied).cwiseAbs().mean() / static_cast<double>(count);
    applied = torque.value();

    const auto truly = arm.true_state();
    const auto pose = Arm{}.at(truly.q);
    const auto& tool = truth.ticks[k].tool;
    const Vector3d e_x = pose.position() - wall - along(tool.x), e_v = pose.jacobian() * truly.qdot - along(tool.v);
    (void)total.add(now, e_x, e_v);
    if (now >= from_seconds(late_seconds)) (void)late.add(now, e_x, e_v);
    if (now >= time_of(count) - from_seconds(rest_seconds)) range.add(truly.q);
  }
  made.l2 = total.total().l2;
  made.late = late.total().l2;
  made.peak = total.total().max;
  made.motion = range.widest();
  return made;
}

}  // namespace

Press press(const Truth& truth, const Trace& wanted, Follower follower) {
  const examples::Scene scene = scene_of(follower);
  const Tracking::Settings thesis = examples::controller_settings(scene);
  switch (follower) {
    case Follower::compensated:
      return press_with(CompensatedTracking<Arm>(compensated(scaled(thesis, 0.57, 4.45, 0.1))), scene, truth, wanted);
    case Follower::compensated_slow:
      return press_with(CompensatedTracking<Arm>(compensated(scaled(thesis, 1.6, 1.5, 0.1))), scene, truth, wanted);
    case Follower::best_of_hold:
      return press_with(Tracking(scaled(thesis, 5.73, 0.07, 0.2)), scene, truth, wanted);
    case Follower::ideal:
      break;
  }
  return press_with(Tracking(thesis), scene, truth, wanted);
}

}  // namespace limpid::bench
