// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/safety_traits.hpp>
#include <limpid/robot/omni.hpp>

#include <cmath>

namespace limpid {

/// The Omni's limits that join several joints, section 5.2.3. All are inclusive at the margin.
/// @realtime  no allocation, no throw; two sines and cosines
template <Real Scalar>
struct SafetyTraits<Omni<Scalar>> {
  static constexpr int half_spaces = 1;
  using Vector = typename Omni<Scalar>::Vector;
  using Allowed = TorqueSet<Omni<Scalar>::joints, Scalar, half_spaces>;

  /// Near q2 + q3 = 0.214, eq. (5.4), neither joint 2 nor joint 3 is pushed further.
  static void limit_joints(const Omni<Scalar>& robot, const Vector& q, const Scalar& margin,
                           Allowed& allowed) noexcept {
    if (q[1] + q[2] < robot.elbow_sum_limit() - margin) return;
    allowed.forbid_positive(1, Status::joint_limit);
    allowed.forbid_positive(2, Status::joint_limit);
  }

  /// Near sqrt(x^2 + y^2) = 0.12 m no torque pushes the tip toward the base: tau' dr/dq >= 0. Near |x| = 0.26 m joint
  /// 3, on which alone |x| depends, is not stretched further.
  static void limit_workspace(const Omni<Scalar>& robot, const Vector& q, const Scalar& margin,
                              Allowed& allowed) noexcept {
    using std::cos, std::sin;
    const Scalar &l2 = robot.link2(), &l3 = robot.link3(), q23 = q[1] + q[2];
    const Scalar c2 = cos(q[1]), s2 = sin(q[1]), c23 = cos(q23), s23 = sin(q23);
    const Scalar r = l2 * c2 + l3 * c23, z = l2 * s2 + l3 * s23;
    const Scalar outward(r < Scalar(0) ? -1 : 1);  // of growing r: the distance is |r|
    if (r * outward <= robot.radius_min() + margin) {
      allowed.demand(Vector(Scalar(0), -z * outward, -l3 * s23 * outward), Status::workspace_limit);
    }
    const Scalar reach = robot.reach_max() - margin;
    if (reach > Scalar(0) && r * r + z * z < reach * reach) return;
    const Scalar s3 = c2 * s23 - s2 * c23;  // d|x|^2/dq3 = -2 l2 l3 s3
    if (s3 <= Scalar(0)) allowed.forbid_positive(2, Status::workspace_limit);
    if (s3 >= Scalar(0)) allowed.forbid_negative(2, Status::workspace_limit);
  }
};

}  // namespace limpid
