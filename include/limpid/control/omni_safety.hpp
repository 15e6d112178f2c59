// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/safety_traits.hpp>
#include <limpid/robot/omni.hpp>

#include <cmath>

namespace limpid {

/// The Omni's limits that join several joints, section 5.2.3. All are inclusive at the margin.
/// @realtime  no allocation, no throw; two sines and cosines, near the reach a square root
template <Real Scalar>
struct SafetyTraits<Omni<Scalar>> {
  static constexpr int half_spaces = 1;
  using Vector = typename Omni<Scalar>::Vector;
  using Allowed = TorqueSet<Omni<Scalar>::joints, Scalar, half_spaces>;

  /// Near q2 + q3 = 0.214, eq. (5.4), neither joint 2 nor joint 3 is pushed further.
  static void limit_joints(const Omni<Scalar>& robot, const Vector& q, const SafetyMargin<Scalar>& margin,
                           Allowed& allowed) noexcept {
    const Scalar share = margin.share(robot.elbow_sum_limit() - (q[1] + q[2]));
    allowed.narrow_positive(1, share, Status::joint_limit);
    allowed.narrow_positive(2, share, Status::joint_limit);
  }

  /// Near sqrt(x^2 + y^2) = 0.12 m the tip, held still, does not press toward the base: e_r' F >= 0 for the force F
  /// with J' F = tau. Near |x| = 0.26 m joint 3, on which alone |x| depends, is not stretched further.
  ///
  /// By (3.13) e_r' J^-T = (0, c23/(l2 s3), -r/(l2 l3 s3)): with the elbow up, s3 < 0, it points along (0, -l3 c23, r),
  /// and against it with the elbow down. Where the arm is straight the force has no bound, and the elbow counts as up.
  static void limit_workspace(const Omni<Scalar>& robot, const Vector& q, const SafetyMargin<Scalar>& margin,
                              Allowed& allowed) noexcept {
    using std::cos, std::sin, std::sqrt;
    const Scalar &l2 = robot.link2(), &l3 = robot.link3(), q23 = q[1] + q[2];
    const Scalar c2 = cos(q[1]), s2 = sin(q[1]), c23 = cos(q23), s23 = sin(q23);
    const Scalar r = l2 * c2 + l3 * c23, z = l2 * s2 + l3 * s23;
    const Scalar s3 = c2 * s23 - s2 * c23;
    const Scalar outward(r < Scalar(0) ? -1 : 1);  // of growing r: the distance is |r|
    const Scalar from_base = margin.share(r * outward - robot.radius_min());
    if (from_base < Scalar(1)) {
      const Scalar sign = s3 > Scalar(0) ? -outward : outward;
      allowed.demand(Vector(Scalar(0), -l3 * c23 * sign, r * sign), from_base, Status::workspace_limit);
    }
    const Scalar clear = robot.reach_max() - margin.margin - margin.band;
    if (clear > Scalar(0) && r * r + z * z < clear * clear) return;
    const Scalar from_edge = margin.share(robot.reach_max() - sqrt(r * r + z * z));
    // d|x|^2/dq3 = -2 l2 l3 s3
    if (s3 <= Scalar(0)) allowed.narrow_positive(2, from_edge, Status::workspace_limit);
    if (s3 >= Scalar(0)) allowed.narrow_negative(2, from_edge, Status::workspace_limit);
  }
};

}  // namespace limpid
