// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/flat.hpp>
#include <limpid/core/lane_math.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/robot/inverse_kinematics.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_lanes.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid {

/// Inverse kinematics of the Omni in closed form, elbow up (q3 <= 0), tip before the base: (3.3)-(3.6), (3.13), (3.14).
///
/// Every angle is an arc tangent of two lengths, well conditioned up to the edges of the workspace, where the arc
/// cosine of (3.5) is not; bench/time_error sets it against the equations as printed. Where the processor has registers
/// of four, the links go side by side (`detail::OmniLanes`). Within 1/256 of a singularity (r over the reach, or
/// |sin q3|) the inverse of J is damped: rates stay bounded, and the direction that the arm has lost is given up first.
///
/// Joints beyond their limits are brought to the nearest admissible ones, in the 2-norm: Table 5.1 and (5.4). Those
/// that were moved have zero rates, the others move as if none had been; the status is then `unreachable`. Joints
/// within 128 roundings of a limit are on it. The Omni's singularities all lie beyond its limits: a damped answer, too,
/// is one for joints that are held, unless an arm with other limits is given.
/// @realtime  inverse: no allocation, no throw; three arc tangents, two square roots
template <Real Scalar_ = double>
class OmniKinematics {
 public:
  using Scalar = Scalar_;
  static constexpr int joints = 3;
  using Vector = Eigen::Matrix<Scalar, 3, 1>;

  struct Limits {
    Vector lower, upper;  ///< of the joints, rad
    Scalar elbow_sum;     ///< largest q2 + q3, rad; eq. (5.4)
  };

  /// @throws std::invalid_argument  where fourth powers of the links' lengths leave the scalar's range
  explicit OmniKinematics(const Omni<Scalar>& robot)
      : OmniKinematics(robot, {robot.limits().lower, robot.limits().upper, robot.elbow_sum_limit()}) {}

  /// @param limits  of an arm with stops of its own; infinite where there is none
  /// @throws std::invalid_argument  as above, and where no joints are within the limits
  OmniKinematics(const Omni<Scalar>& robot, const Limits& limits)
      : limits_{limits},
        l2_{robot.link2()},
        l3_{robot.link3()},
        outer_{l2_ + l3_},
        inner_{innermost(l2_, l3_)},
        per_twice_l2l3_{1 / (2 * l2_ * l3_)},
        lanes_(l2_, l3_, limits.lower, limits.upper, limits.elbow_sum, near_axis(), near_straight()) {
    using std::min;
    const Scalar longest = outer_ * outer_, shortest = min(l2_, l3_) * min(l2_, l3_);
    expect(is_finite(Scalar(longest * longest)), "OmniKinematics: links", "lengths whose fourth power is finite",
           outer_);
    expect(shortest * shortest > std::numeric_limits<Scalar>::min() / std::numeric_limits<Scalar>::epsilon(),
           "OmniKinematics: links", "lengths whose fourth power is in range", min(l2_, l3_));
    const Scalar infinity = std::numeric_limits<Scalar>::infinity();
    expect((limits.lower.array() <= limits.upper.array()).all(), "OmniKinematics: lower", "<= upper", limits.lower);
    expect((limits.lower.array() < infinity).all(), "OmniKinematics: lower", "below infinity", limits.lower);
    expect((limits.upper.array() > -infinity).all(), "OmniKinematics: upper", "above -infinity", limits.upper);
    expect(limits.elbow_sum >= limits.lower[1] + limits.lower[2], "OmniKinematics: elbow_sum",
           ">= the sum of the lower limits", limits.elbow_sum);
    expect(limits.elbow_sum > -infinity, "OmniKinematics: elbow_sum", "above -infinity", limits.elbow_sum);
  }

  /// @param x     tip in the base frame, m
  /// @param near  rad; gives q1 where the tip is on the vertical axis, and the answer where x is not finite; looked at
  ///              only there, and taken as zero where it is not finite itself
  [[nodiscard]] InverseJoints<3, Scalar> inverse(const Vector& x, const Vector& near = Vector::Zero()) const noexcept {
    if constexpr (LanesOfArm::pay) {
      typename LanesOfArm::Motion motion;
      if (lanes_.inverse(x, Vector::Zero(), Vector::Zero(), motion)) [[likely]] {
        const auto held = within_limits(motion.q, motion.qdot, motion.qddot, Status::ok);
        return {held.q, held.status};
      }
    }
    if (!is_finite(x)) return {fallback(near), Status::not_finite};
    Arm arm = reach(x, near);
    if (is_beyond_limits(arm.q)) (void)hold_within_limits(arm);
    return {arm.q, arm.status};
  }

  /// @param x, v, a  tip in the base frame, m, m/s, m/s^2
  /// @param near     as above; where x, v or a is not finite the answer is `near` at rest
  [[nodiscard]] InverseMotion<3, Scalar> inverse(const Vector& x, const Vector& v, const Vector& a,
                                                 const Vector& near = Vector::Zero()) const noexcept {
    return flat<Scalar>([&]() noexcept { return motion_of(x, v, a, near); });
  }

 private:
  using Held = Eigen::Array<bool, joints, 1>;  // of the joints: at a limit

  [[nodiscard]] InverseMotion<3, Scalar> motion_of(const Vector& x, const Vector& v, const Vector& a,
                                                   const Vector& near) const noexcept {
    if constexpr (LanesOfArm::pay) {
      typename LanesOfArm::Motion motion;
      if (lanes_.inverse(x, v, a, motion)) [[likely]] {
        if (motion.at_limits) [[unlikely]] {
          const auto free = motion;  // a copy, so that the usual one stays in registers; below too
          return within_limits(free.q, free.qdot, free.qddot, Status::ok);
        }
        return {{motion.q, motion.qdot, motion.qddot}, Status::ok};
      }
      const Vector x_here = x, v_here = v, a_here = a;
      return motion_anywhere(x_here, v_here, a_here, near);
    }
    return motion_anywhere(x, v, a, near);
  }

  [[nodiscard, gnu::noinline]] InverseMotion<3, Scalar> motion_anywhere(const Vector& x, const Vector& v,
                                                                        const Vector& a,
                                                                        const Vector& near) const noexcept {
    if (!are_finite(x.array(), v.array(), a.array())) return at_rest(fallback(near), Status::not_finite);
    Arm arm = reach(x, near);
    Vector qdot = joint_rates(arm, into_arm(arm, v));                            // (3.12)
    Vector qddot = joint_rates(arm, into_arm(arm, a) - centripetal(arm, qdot));  // (3.14)
    const bool in_range = is_finite(qddot);                                      // else v or a is beyond any range
    if (!in_range) {
      if (is_beyond_limits(arm.q)) (void)hold_within_limits(arm);
      return at_rest(arm.q, arm.status | Status::not_finite);
    }
    return within_limits(arm.q, qdot, qddot, arm.status);
  }

  [[nodiscard, gnu::noinline]] InverseMotion<3, Scalar> within_limits(const Vector& q, const Vector& qdot,
                                                                      const Vector& qddot,
                                                                      Status status) const noexcept {
    if (!is_beyond_limits(q)) return {{q, qdot, qddot}, status};
    Arm arm;
    arm.q = q;
    arm.status = status;
    const auto held = hold_within_limits(arm);
    return {{arm.q, held.select(Vector::Zero(), qdot), held.select(Vector::Zero(), qddot)}, arm.status};
  }

  // The arm at its target.
  struct Arm {
    Vector q;  // rad
    Scalar c1, s1, c2, s2, c23, s23;
    Scalar r, z;            // m
    Scalar per_r, per_det;  // of joint 1 and of joints 2 and 3, 1/m and 1/m^2; bounded
    bool straight;          // whether joints 2 and 3 need damping
    Status status;
  };

  [[nodiscard]] Arm reach(const Vector& x, const Vector& near) const noexcept {
    using std::sqrt, std::max;
    const Scalar rounding = 8 * std::numeric_limits<Scalar>::epsilon();  // of |x|^2, in the forward map and here
    Vector target = x;
    Scalar square = target.squaredNorm();
    Arm arm;
    arm.status = Status::ok;
    if (!(square <= outer_ * outer_ * (1 + rounding) && square >= inner_ * inner_ * (1 - rounding))) {
      arm.status = Status::unreachable;
      target = nearest_reachable(x);
      square = target.squaredNorm();
    }
    const Scalar level = target[0] * target[0] + target[1] * target[1];
    const Scalar r = sqrt(level), z = target[2];  // (3.4)
    // (3.5): 2 l2 l3 times the cosine and, by Heron's formula, the sine of q3.
    const Scalar cosine = square - l2_ * l2_ - l3_ * l3_;
    const Scalar sine = -sqrt(max((square - (l2_ - l3_) * (l2_ - l3_)) * (outer_ * outer_ - square), Scalar(0)));
    const Scalar c3 = cosine * per_twice_l2l3_, s3 = sine * per_twice_l2l3_;
    // (3.6): |x|^2 times the cosine and the sine of q2, the tip's elevation plus the angle between the tip and link 2.
    const Scalar along = l2_ + l3_ * c3, across = -l3_ * s3;
    const Scalar forward = r * along - z * across, upward = z * along + r * across;

    arm.q = arc_tangent(to_lanes<joints>(Vector(target[1], upward, sine).array()),
                        to_lanes<joints>(Vector(target[0], forward, cosine).array()))
                .template head<joints>();
    const Scalar once_per_r = 1 / r, per_square = 1 / square;
    arm.c1 = target[0] * once_per_r;
    arm.s1 = target[1] * once_per_r;
    arm.c2 = forward * per_square;
    arm.s2 = upward * per_square;
    arm.c23 = arm.c2 * c3 - arm.s2 * s3;
    arm.s23 = arm.s2 * c3 + arm.c2 * s3;
    arm.r = r;
    arm.z = z;
    arm.per_r = r < near_axis() ? r / (near_axis() * near_axis()) : once_per_r;
    arm.straight = -s3 < near_straight();
    arm.per_det = arm.straight ? Scalar(0) : 2 / sine;
    arm.status |= when(r < near_axis() || arm.straight, Status::singular);
    if (level < std::numeric_limits<Scalar>::min() / std::numeric_limits<Scalar>::epsilon()) keep_joint_1(arm, near);
    return arm;
  }

  [[nodiscard]] bool is_beyond_limits(const Vector& q) const noexcept {
    const Scalar rounding = 128 * std::numeric_limits<Scalar>::epsilon();  // of q near the limits, in the inverse
    const Vector beyond = (q - limits_.upper).cwiseMax(limits_.lower - q);
    return std::max(beyond.maxCoeff(), Scalar(q[1] + q[2] - limits_.elbow_sum)) > rounding;
  }

  // Brings q to the nearest joints within the limits. Where (5.4) is broken within the box of the others, they are on
  // its line, between the two corners where that leaves the box.
  [[nodiscard, gnu::noinline]] Held hold_within_limits(Arm& arm) const noexcept {
    using std::max, std::min;
    const Vector q = arm.q;
    arm.q = q.cwiseMax(limits_.lower).cwiseMin(limits_.upper);
    Held held = arm.q.array() != q.array();
    if (arm.q[1] + arm.q[2] > limits_.elbow_sum) {
      const Scalar sum = limits_.elbow_sum, nearest = q[1] - (q[1] + q[2] - sum) / 2;
      arm.q[1] = min(max(nearest, max(limits_.lower[1], sum - limits_.upper[2])),
                     min(limits_.upper[1], sum - limits_.lower[2]));
      arm.q[2] = min(max(sum - arm.q[1], limits_.lower[2]), limits_.upper[2]);  // the corners are rounded
      held[1] = held[2] = true;
    }
    arm.status |= Status::unreachable;
    return held;
  }

  // On the vertical axis, where no q1 is better than another.
  [[gnu::noinline]] static void keep_joint_1(Arm& arm, const Vector& near) noexcept {
    using std::cos, std::sin;
    arm.q[0] = fallback(near)[0];
    arm.c1 = cos(arm.q[0]);
    arm.s1 = sin(arm.q[0]);
    arm.status |= when(!is_finite(near), Status::not_finite);
  }

  // From the base frame into the arm's: along r, around the axis, up.
  [[nodiscard]] static Vector into_arm(const Arm& arm, const Vector& v) noexcept {
    return {arm.c1 * v[0] + arm.s1 * v[1], arm.c1 * v[1] - arm.s1 * v[0], v[2]};
  }

  // J^-1 of (3.13) on a vector of the arm's frame.
  [[nodiscard]] Vector joint_rates(const Arm& arm, const Vector& v) const noexcept {
    const Scalar q1 = v[1] * arm.per_r;
    if (arm.straight) return damped_joint_rates(arm, v, q1);
    return {q1, (arm.c23 * v[0] + arm.s23 * v[2]) * l3_ * arm.per_det, -(arm.r * v[0] + arm.z * v[2]) * arm.per_det};
  }

  // Least squares on joints 2 and 3, damped by what lifts the small singular value as s3 goes to 0.
  [[nodiscard, gnu::noinline]] Vector damped_joint_rates(const Arm& arm, const Vector& v,
                                                         const Scalar& q1) const noexcept {
    Eigen::Matrix<Scalar, 2, 2> J;  // (3.9) in the arm's plane
    J << -arm.z, -l3_ * arm.s23,    //
        arm.r, l3_ * arm.c23;
    const Scalar edge = near_straight() * l2_ * l3_, det = J.determinant();
    const Scalar missing = (edge * edge - det * det) / (outer_ * outer_);  // squares of the small singular value, about
    const Eigen::Matrix<Scalar, 2, 2> square = J.transpose() * J + missing * Eigen::Matrix<Scalar, 2, 2>::Identity();
    const Eigen::Matrix<Scalar, 2, 1> rates =
        square.inverse() * (J.transpose() * Eigen::Matrix<Scalar, 2, 1>(v[0], v[2]));
    return {q1, rates[0], rates[1]};
  }

  // J' q' in the arm's frame: toward the axis and the two link roots, and Coriolis around the axis.
  [[nodiscard]] Vector centripetal(const Arm& arm, const Vector& qdot) const noexcept {
    const Scalar q23dot = qdot[1] + qdot[2];
    const Scalar around1 = qdot[0] * qdot[0], link2 = l2_ * qdot[1] * qdot[1], link3 = l3_ * q23dot * q23dot;
    const Scalar rdot = -arm.z * qdot[1] - l3_ * arm.s23 * qdot[2];
    return {-arm.r * around1 - link2 * arm.c2 - link3 * arm.c23, 2 * rdot * qdot[0], -link2 * arm.s2 - link3 * arm.s23};
  }

  [[nodiscard, gnu::noinline]] Vector nearest_reachable(const Vector& x) const noexcept {
    const Scalar size = x.cwiseAbs().maxCoeff();  // taken out first: a square would leave the range of Scalar
    if (!(size > Scalar(0))) return {Scalar(0), Scalar(0), inner_};  // at the shoulder no direction is nearer
    const Vector scaled = x / size;
    return scaled.normalized() * (size * scaled.norm() < inner_ ? inner_ : outer_);
  }

  [[nodiscard]] static Vector fallback(const Vector& near) noexcept { return is_finite(near) ? near : Vector::Zero(); }

  [[nodiscard]] static InverseMotion<3, Scalar> at_rest(const Vector& q, Status status) noexcept {
    return {{q, Vector::Zero(), Vector::Zero()}, status};
  }

  [[nodiscard]] Scalar near_axis() const noexcept { return outer_ / 256; }                  // of r, m
  [[nodiscard]] static Scalar near_straight() noexcept { return Scalar(1) / Scalar(256); }  // of |sin q3|

  // Links of equal length fold onto the shoulder, where q2 would be open.
  [[nodiscard]] static Scalar innermost(const Scalar& l2, const Scalar& l3) noexcept {
    using std::abs, std::sqrt, std::max;
    const Scalar folded = abs(l2 - l3), open = (l2 + l3) * sqrt(std::numeric_limits<Scalar>::epsilon());
    return max(folded, open);
  }

  using LanesOfArm = typename detail::OmniLanesOf<Scalar>::type;

  Limits limits_;
  Scalar l2_, l3_;         // m
  Scalar outer_, inner_;   // reachable distances of the tip from the shoulder, m
  Scalar per_twice_l2l3_;  // 1/m^2
  [[no_unique_address]] LanesOfArm lanes_;
};

}  // namespace limpid
