// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/robot/five_bar.hpp>
#include <limpid/robot/inverse_kinematics.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid {

/// Inverse kinematics of the FiveBar in closed form: elbows outward, the tip ahead of them.
///
/// Each side is an arm of two links for itself. Its elbow lies off the way from its base joint to the tip by an angle
/// whose sine comes from Heron's formula, so that q_i is an arc tangent of two lengths, taken about the middle of its
/// limits: well conditioned up to the stretched and the folded arm. With u_i along the distal link and e_i to the elbow
///
///     w_i q_i' = u_i . v        w_i q_i'' = u_i . (a - e_i'') + |v - e_i'|^2 / l2
///
/// Joints beyond their limits are brought to the nearest within, with zero rates, while the other joint moves as if
/// they had not been; the status is then `unreachable`. Joints within 128 roundings of a limit are on it. A target
/// behind the line of the elbows, where only another assembly could have its tip, gives the limits that open the device
/// most, (upper q1, lower q2), at rest. The limits keep clear of singularities, so that damping, which keeps rates
/// bounded within 1/256 of them, only ever touches joints whose target is `unreachable` besides `singular`.
///
/// The tip stays in the plane: what x, v and a have off it, beyond their rounding, is left out, and the status
/// `unreachable`, since the tip does not go there.
/// @realtime  inverse: no allocation, no throw; two arc tangents, four square roots
template <Real Scalar_ = double>
class FiveBarKinematics {
 public:
  using Scalar = Scalar_;
  static constexpr int joints = 2;
  using Vector = Eigen::Matrix<Scalar, joints, 1>;
  using Point = Eigen::Matrix<Scalar, 3, 1>;

  /// @throws std::invalid_argument  where fourth powers of the links' lengths leave the scalar's range
  explicit FiveBarKinematics(const FiveBar<Scalar>& robot)
      : lower_{robot.limits().lower},
        upper_{robot.limits().upper},
        base_x_{-robot.base() / 2, robot.base() / 2},
        l1_{robot.proximal()},
        l2_{robot.distal()},
        outer_{l1_ + l2_},
        inner_{innermost(l1_, l2_)} {
    using std::cos, std::min, std::sin;
    const Scalar longest = outer_ * outer_, shortest = min(l1_, l2_) * min(l1_, l2_);
    expect(is_finite(Scalar(longest * longest)), "FiveBarKinematics: links", "lengths whose fourth power is finite",
           outer_);
    expect(shortest * shortest > std::numeric_limits<Scalar>::min() / std::numeric_limits<Scalar>::epsilon(),
           "FiveBarKinematics: links", "lengths whose fourth power is in range", min(l1_, l2_));
    const Vector middle = (lower_ + upper_) / Scalar(2);
    middle_ = middle;
    cosines_ = {cos(middle[0]), cos(middle[1])};
    sines_ = {sin(middle[0]), sin(middle[1])};
  }

  /// @param x     tip in the base frame, m
  /// @param near  rad; the answer where x is not finite, zero where it is not finite itself; looked at only there
  [[nodiscard]] InverseJoints<joints, Scalar> inverse(const Point& x,
                                                      const Vector& near = Vector::Zero()) const noexcept {
    if (!is_finite(x)) return {fallback(near), Status::not_finite};
    Arms arms = reach(x);
    (void)hold_within_limits(arms);
    return {arms.q, arms.status};
  }

  /// @param x, v, a  tip in the base frame, m, m/s, m/s^2
  /// @param near     as above; where x, v or a is not finite the answer is `near` at rest
  [[nodiscard]] InverseMotion<joints, Scalar> inverse(const Point& x, const Point& v, const Point& a,
                                                      const Vector& near = Vector::Zero()) const noexcept {
    if (!(is_finite(x) && is_finite(v) && is_finite(a))) return at_rest(fallback(near), Status::not_finite);
    Arms arms = reach(x);
    arms.status |= when(leaves_plane(v) || leaves_plane(a), Status::unreachable);
    Vector qdot = (arms.ux * v[0] + arms.uy * v[1]).cwiseProduct(arms.per_w);
    Vector qddot = accelerations(arms, v, a, qdot);
    const bool in_range = is_finite(qddot);  // else v or a is beyond any range
    const Held held = hold_within_limits(arms);
    if (!in_range) return at_rest(arms.q, arms.status | Status::not_finite);
    qdot = held.select(Vector::Zero(), qdot);
    qddot = held.select(Vector::Zero(), qddot);
    return {{arms.q, qdot, qddot}, arms.status};
  }

 private:
  using Held = Eigen::Array<bool, joints, 1>;  // of the joints: at a limit

  // Both sides at the target.
  struct Arms {
    Vector q;       // rad
    Vector ex, ey;  // from a base joint to its elbow, by components, m
    Vector ux, uy;  // along the distal links
    Vector per_w;   // 1/m; bounded
    Status status;
  };

  [[nodiscard]] Arms reach(const Point& x) const noexcept {
    Arms arms;
    arms.status = when(magnitude(x[2]) > rounding() * outer_, Status::unreachable);
    reach_side(0, Scalar(1), x, arms);
    reach_side(1, Scalar(-1), x, arms);
    return arms;
  }

  // @param outward  1 where the elbow is to the left of the way to the tip, -1 where to the right
  void reach_side(int i, const Scalar& outward, const Point& x, Arms& arms) const noexcept {
    using std::atan2, std::max, std::sqrt;
    Vector to_tip(x[0] - base_x_[i], x[1]);
    const Scalar size = to_tip.cwiseAbs().maxCoeff();  // taken out first: a square would leave the range of Scalar
    to_tip = size > Scalar(0) ? Vector(to_tip / size) : Vector(Scalar(0), Scalar(1));
    const Scalar length = to_tip.norm(), wanted = size * length;
    to_tip /= length;
    const Scalar r = wanted > outer_ ? outer_ : max(wanted, inner_);
    // 2 r times the elbow's way along the way to the tip and, by Heron's formula, off it
    const Scalar along = r * r + l1_ * l1_ - l2_ * l2_;
    const Scalar off = sqrt(max((r * r - (l1_ - l2_) * (l1_ - l2_)) * (outer_ * outer_ - r * r), Scalar(0)));
    const Scalar side = outward * off;
    const Vector elbow = Vector(to_tip[0] * along - to_tip[1] * side, to_tip[1] * along + to_tip[0] * side) / (2 * r);
    const Scalar w = -side / (2 * l2_), edge = l1_ / Scalar(256);

    arms.q[i] = middle_[i] +
                atan2(cosines_[i] * elbow[1] - sines_[i] * elbow[0], cosines_[i] * elbow[0] + sines_[i] * elbow[1]);
    arms.ex[i] = elbow[0];
    arms.ey[i] = elbow[1];
    arms.ux[i] = (r * to_tip[0] - elbow[0]) / l2_;
    arms.uy[i] = (r * to_tip[1] - elbow[1]) / l2_;
    arms.per_w[i] = w / max(w * w, edge * edge);
    arms.status |= when(wanted != r, Status::unreachable) | when(magnitude(w) < edge, Status::singular);
  }

  [[nodiscard]] Vector accelerations(const Arms& arms, const Point& v, const Point& a,
                                     const Vector& qdot) const noexcept {
    const Vector square = qdot.cwiseProduct(qdot);
    const Vector ax = a[0] + (square.cwiseProduct(arms.ex)).array();  // less e_i'', but for its part with q_i''
    const Vector ay = a[1] + (square.cwiseProduct(arms.ey)).array();
    const Vector vx = v[0] + (qdot.cwiseProduct(arms.ey)).array();  // less e_i'
    const Vector vy = v[1] - (qdot.cwiseProduct(arms.ex)).array();
    const Vector across = (vx.cwiseProduct(vx) + vy.cwiseProduct(vy)) / l2_;
    return (arms.ux.cwiseProduct(ax) + arms.uy.cwiseProduct(ay) + across).cwiseProduct(arms.per_w);
  }

  // Brings q to the nearest joints within the limits.
  [[nodiscard]] Held hold_within_limits(Arms& arms) const noexcept {
    const Vector between(base_x_[1] - base_x_[0] + arms.ex[1] - arms.ex[0], arms.ey[1] - arms.ey[0]);  // the elbows, m
    const bool ahead = between[0] * arms.uy.sum() - between[1] * arms.ux.sum() > Scalar(0);
    if (!ahead) {
      arms.q = {upper_[0], lower_[1]};
      arms.status |= Status::unreachable;
      return Held::Constant(true);
    }
    const Scalar rounding = 128 * std::numeric_limits<Scalar>::epsilon();  // of q near the limits
    Held held = arms.q.array() > upper_.array() + rounding || arms.q.array() < lower_.array() - rounding;
    arms.q = held.select(arms.q.cwiseMax(lower_).cwiseMin(upper_), arms.q);
    arms.status |= when(held.any(), Status::unreachable);
    return held;
  }

  [[nodiscard]] static bool leaves_plane(const Point& v) noexcept {
    return magnitude(v[2]) > rounding() * v.template head<2>().cwiseAbs().maxCoeff();
  }

  [[nodiscard]] static Vector fallback(const Vector& near) noexcept { return is_finite(near) ? near : Vector::Zero(); }

  [[nodiscard]] static InverseMotion<joints, Scalar> at_rest(const Vector& q, Status status) noexcept {
    return {{q, Vector::Zero(), Vector::Zero()}, status};
  }

  [[nodiscard]] static Scalar magnitude(const Scalar& value) noexcept { return value < Scalar(0) ? -value : value; }
  [[nodiscard]] static Scalar rounding() noexcept { return 8 * std::numeric_limits<Scalar>::epsilon(); }

  // Links of equal length fold onto the base joint, where the angle would be open.
  [[nodiscard]] static Scalar innermost(const Scalar& l1, const Scalar& l2) noexcept {
    using std::max, std::sqrt;
    return max(magnitude(l1 - l2), (l1 + l2) * sqrt(std::numeric_limits<Scalar>::epsilon()));
  }

  Vector lower_, upper_;            // of the joints, rad
  Vector middle_;                   // of the limits, rad
  Vector cosines_, sines_;          // of the middle
  Vector base_x_;                   // of the base joints, m
  Scalar l1_, l2_, outer_, inner_;  // links, and reachable distances of the tip from a base joint, m
};

}  // namespace limpid
