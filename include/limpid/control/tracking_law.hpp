// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/robot/joint_state.hpp>
#include <limpid/robot/robot.hpp>

#include <Eigen/Core>

#include <concepts>
#include <limits>
#include <string>
#include <string_view>

namespace limpid {

/// What a setting without a sensible default holds until it is given, so that `expect` names it: NaN.
template <typename V>
[[nodiscard]] V unset() {
  return V::Constant(std::numeric_limits<typename V::Scalar>::quiet_NaN());
}

/// The part that the controllers with known and with adapted parameters share: (4.1), (4.3) and (4.2) = (4.7).
///
///     q_r' = q_e' - Lambda (q - q_e)        delta = q' - q_r'        tau = phi_r theta - K_d delta - J' F_h
///
/// @realtime  no allocation, no throw
template <Robot R>
struct TrackingLaw {
  using Scalar = RobotScalar<R>;
  using Joints = JointVector<R>;
  using Force = Eigen::Matrix<Scalar, 3, 1>;

  struct Reference {
    Joints qdot;   ///< q_r', rad/s
    Joints qddot;  ///< q_r'', rad/s^2
    Joints delta;  ///< controller error, rad/s
  };

  Joints Lambda;  ///< diagonal, 1/s
  Joints Kd;      ///< diagonal, N m s/rad

  /// @throws std::invalid_argument  "CLASS: Lambda: ..." where a gain is not positive and finite
  void check(std::string_view name) const {
    expect(is_finite(Lambda) && (Lambda.array() > Scalar(0)).all(), std::string(name) + ": Lambda", "finite and > 0",
           Lambda);
    expect(is_finite(Kd) && (Kd.array() > Scalar(0)).all(), std::string(name) + ": Kd", "finite and > 0", Kd);
  }

  [[nodiscard]] Reference reference(const JointState<RobotTraits<R>::joints, Scalar>& is,
                                    const DesiredJoints<RobotTraits<R>::joints, Scalar>& wanted) const noexcept {
    Reference r;
    r.qdot = wanted.qdot - Lambda.cwiseProduct(is.q - wanted.q);
    r.qddot = wanted.qddot - Lambda.cwiseProduct(is.qdot - wanted.qdot);
    r.delta = is.qdot - r.qdot;
    return r;
  }

  /// @param F_h  operator's force on the tip, N, base frame
  [[nodiscard]] Joints torque(const PoseOf<R>& pose, const RobotParameters<R>& theta, const Joints& qdot,
                              const Reference& r, const Force& F_h) const noexcept {
    return pose.torque(theta, qdot, r.qdot, r.qddot) - Kd.cwiseProduct(r.delta) - torque_of(pose, F_h);
  }

 private:
  // J' F, by the pose's own short cut where it has one.
  [[nodiscard]] static Joints torque_of(const PoseOf<R>& pose, const Force& F) noexcept {
    if constexpr (requires {
                    { pose.torque_of(F) } -> std::convertible_to<Joints>;
                  }) {
      return pose.torque_of(F);
    } else {
      return pose.jacobian().transpose() * F;
    }
  }
};

}  // namespace limpid
