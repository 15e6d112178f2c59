// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/tracking_law.hpp>
#include <limpid/core/status.hpp>

namespace limpid {

/// Tracking controller for a robot whose parameters are known. Eqs. (4.1)-(4.3).
///
/// In closed loop H delta' + (C + B + K_d) delta = 0, eq. (4.4), and q - q_e follows delta through Lambda.
/// @tparam R  a Robot of n joints and p parameters
/// @realtime  update: no allocation, no throw
template <Robot R>
class ComputedTorque {
 public:
  using Scalar = RobotScalar<R>;
  using Joints = JointVector<R>;
  using Force = typename TrackingLaw<R>::Force;

  struct Settings {
    R robot{};
    Joints Lambda = unset<Joints>();                         ///< diagonal of Lambda, 1/s; > 0
    Joints Kd = unset<Joints>();                             ///< diagonal of K_d, N m s/rad; > 0
    RobotParameters<R> theta = unset<RobotParameters<R>>();  ///< the robot's parameters
  };

  struct Output {
    Joints tau;     ///< N m; always finite
    Status status;  ///< not_finite where the last good torque was kept
  };

  /// @throws std::invalid_argument  where a gain or a parameter cannot serve
  explicit ComputedTorque(const Settings& settings)
      : robot_{settings.robot}, law_{settings.Lambda, settings.Kd}, theta_{settings.theta} {
    law_.check("ComputedTorque");
    expect(is_finite(theta_), "ComputedTorque: theta", "finite", theta_);
  }

  /// The torque that moves the joints from `is` toward `wanted` under the operator's force F_h, N, base frame.
  [[nodiscard]] Output update(const JointState<RobotTraits<R>::joints, Scalar>& is,
                              const DesiredJoints<RobotTraits<R>::joints, Scalar>& wanted, const Force& F_h) noexcept {
    const auto pose = RobotTraits<R>::at(robot_, is.q);
    const Joints tau = law_.torque(pose, theta_, is.qdot, law_.reference(is, wanted), F_h);
    if (!is_finite(tau)) return {tau_, Status::not_finite};  // which every non-finite input makes it: RobotPose's law
    tau_ = tau;
    return {tau_, Status::ok};
  }

 private:
  R robot_;
  TrackingLaw<R> law_;
  RobotParameters<R> theta_;
  Joints tau_ = Joints::Zero();  // last good torque
};

}  // namespace limpid
