// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/robot/damped_inverse.hpp>
#include <limpid/robot/inverse_kinematics.hpp>
#include <limpid/robot/serial_chain.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace limpid {

/// Inverse kinematics of the tip's position for any SerialChain, by damped least squares (Levenberg, Marquardt;
/// Wampler 1986, Nakamura and Hanafusa 1986) from `near`, within the joints' limits.
///
///     q <- q + J' (J J' + nu |e|^2)^-1 e,   e = x - x(q)
///
/// nu grows until the error falls and shrinks while it does, so that the end of the search is Newton's. Joints at a
/// limit that e presses against it are held. A search ends where a step takes less than 1/8192 of the error away; one
/// that ends short of the target begins again from other joints,
/// beside `near` and then across the limits. Where the joints are redundant, steps, rates and accelerations are those
/// of least norm: q stays near `near`, and a path is not closed in q because it is in x.
///
/// Rates and accelerations come from J by DampedInverse, without the joints that are held, which have zero. A target
/// that is not met gives the nearest joints found, of the first search unless another came nearer by 1/256 of the
/// reach.
/// @realtime  inverse: no allocation, no throw; at most (1 + restarts) most_steps poses and Jacobians, one for a target
///            at `near`, three or four for one of the next tick
template <int N, Real Scalar_ = double>
requires(N >= 3) class ChainKinematics {
 public:
  using Scalar = Scalar_;
  static constexpr int joints = N;
  using Point = Eigen::Matrix<Scalar, 3, 1>;
  using Joints = Eigen::Matrix<Scalar, N, 1>;

  struct Settings {
    int most_steps = 50;  ///< of a search; > 0
    int restarts = 4;     ///< searches after the first; >= 0
  };

  /// @throws std::invalid_argument  where a setting is out of range, or the reach is zero or, with a sliding joint that
  ///                                has no limits, infinite, or has no square in the scalar's range
  explicit ChainKinematics(const SerialChain<N, Scalar>& robot, const Settings& settings = Settings{})
      : robot_{robot},
        lower_{robot.limits().lower},
        upper_{robot.limits().upper},
        settings_{settings},
        reach_{robot.reach()},
        tolerance_{32 * std::numeric_limits<Scalar>::epsilon() * reach_} {
    expect(is_finite(reach_) && reach_ > Scalar(0), "ChainKinematics: reach of the robot", "finite and > 0", reach_);
    expect(is_finite(Scalar(reach_ * reach_)) &&
               edge() * edge() > std::numeric_limits<Scalar>::min() / std::numeric_limits<Scalar>::epsilon(),
           "ChainKinematics: reach of the robot", "one with a square in the scalar's range", reach_);
    expect(settings.most_steps > 0, "ChainKinematics: most_steps", "> 0", settings.most_steps);
    expect(settings.restarts >= 0, "ChainKinematics: restarts", ">= 0", settings.restarts);
  }

  /// @param x     tip in the base frame, m
  /// @param near  rad; where the search starts, and the answer where x is not finite; taken as zero where it is not
  ///              finite itself
  [[nodiscard]] InverseJoints<N, Scalar> inverse(const Point& x, const Joints& near) const noexcept {
    if (!is_finite(x)) return {fallback(near), Status::not_finite};
    const Found found = find(x, near);
    const bool singular = DampedInverse<N, Scalar>(found.J, edge()).is_singular();
    return {found.q, found.status | when(singular, Status::singular)};
  }

  /// @param x, v, a  tip in the base frame, m, m/s, m/s^2
  /// @param near     as above; where x, v or a is not finite the answer is `near` at rest
  [[nodiscard]] InverseMotion<N, Scalar> inverse(const Point& x, const Point& v, const Point& a,
                                                 const Joints& near) const noexcept {
    if (!(is_finite(x) && is_finite(v) && is_finite(a))) return at_rest(fallback(near), Status::not_finite);
    Found found = find(x, near);
    const Pose pose = robot_.at(found.q);
    Joints qdot, qddot;
    bool singular = false;
    for (int pass = 0; pass <= N; ++pass) {  // each holds a joint more, or is the last
      const DampedInverse<N, Scalar> inverse(found.J, edge());
      singular = inverse.is_singular();
      qdot = inverse(v);                                           // (3.12)
      qddot = inverse(Point(a - pose.jacobian_dot(qdot) * qdot));  // (3.14)
      const Held outward = pressed(found.q, qdot) || ((qdot.array() == Scalar(0)) && pressed(found.q, qddot));
      if (!(outward && !found.held).any()) break;
      hold(found, outward);
    }
    if (!is_finite(qdot) || !is_finite(qddot)) return at_rest(found.q, found.status | Status::not_finite);
    return {{found.q, qdot, qddot}, found.status | when(singular, Status::singular)};
  }

 private:
  using Held = Eigen::Array<bool, N, 1>;  // of the joints: at a limit
  using Pose = SerialChainPose<N, Scalar>;
  using Jacobian = Eigen::Matrix<Scalar, 3, N>;

  struct Found {
    Joints q;
    Point e;     // from the tip to the target, m
    Jacobian J;  // at q, with zeros for the joints that are held
    Held held;
    Status status;
  };

  [[nodiscard]] Found find(const Point& x, const Joints& near) const noexcept {
    const Point target = within_reach(x);
    Found best = search(target, clamped(fallback(near)));
    for (int k = 1; k <= settings_.restarts && best.status != Status::ok; ++k) {
      const Found other = search(target, start(k, fallback(near)));
      if (other.status == Status::ok || other.e.norm() < best.e.norm() - edge()) best = other;
    }
    best.status |= when(target != x, Status::unreachable);
    best.status |= when(!is_finite(near), Status::not_finite);
    return best;
  }

  [[nodiscard]] Found search(const Point& x, const Joints& q) const noexcept {
    Pose pose = robot_.at(q);
    Found at{q, x - pose.position(), pose.jacobian(), Held::Constant(false), Status::ok};
    Scalar nu = Scalar(1) / Scalar(2), error = at.e.norm();
    hold_pressed(at);
    for (int step = 0; step < settings_.most_steps && error > tolerance_; ++step) {
      if ((at.J.transpose() * at.e).norm() <= level() * error) break;  // no motion comes nearer
      Eigen::Matrix<Scalar, 3, 3> square = at.J * at.J.transpose();
      square.diagonal().array() += nu * error * error + std::numeric_limits<Scalar>::epsilon() * reach_ * reach_;
      const Joints next = clamped(at.q + at.J.transpose() * square.llt().solve(at.e));
      pose = robot_.at(next);
      const Point e = x - pose.position();
      const Scalar rest = e.norm();
      nu = rest < error ? nu / 2 : nu * 8;
      if (!(rest < error)) continue;
      const bool stalled = rest > error - error / 8192;
      at = {next, e, pose.jacobian(), Held::Constant(false), Status::ok};
      hold_pressed(at);
      error = rest;
      if (stalled) break;
    }
    at.status = when(error > tolerance_, Status::unreachable);
    if (at.status != Status::ok) return at;
    if (at.held.any()) at.J = robot_.at(at.q).jacobian();  // what is met presses nothing
    at.held.setConstant(false);
    return at;
  }

  // Holds the joints that e presses against their limits.
  void hold_pressed(Found& at) const noexcept { hold(at, pressed(at.q, at.J.transpose() * at.e)); }

  static void hold(Found& at, const Held& more) noexcept {
    at.held = at.held || more;
    for (int i = 0; i < N; ++i) {
      if (at.held[i]) at.J.col(i).setZero();
    }
  }

  // Joints on a limit, to a rounding, that would move beyond it.
  [[nodiscard]] Held pressed(const Joints& q, const Joints& direction) const noexcept {
    const Scalar rounding = 8 * std::numeric_limits<Scalar>::epsilon();
    const auto low = q.array() <= lower_.array() + rounding * lower_.array().abs();
    const auto high = q.array() >= upper_.array() - rounding * upper_.array().abs();
    return (low && direction.array() < Scalar(0)) || (high && direction.array() > Scalar(0));
  }

  // Of search k: first beside `near`, which may be where no step leads toward x, then spread over the limits or, where
  // there are none, over a turn.
  [[nodiscard]] Joints start(int k, const Joints& near) const noexcept {
    using std::floor;
    const Scalar golden = Scalar(1618034) / Scalar(1000000);
    Joints q;
    for (int i = 0; i < N; ++i) {
      const Scalar turns = golden * Scalar((i + 1) * k), share = turns - floor(turns);
      const bool bounded = is_finite(lower_[i]) && is_finite(upper_[i]);
      const Scalar low = bounded ? lower_[i] : near[i] - 3, high = bounded ? upper_[i] : near[i] + 3;
      q[i] = k == 1 ? near[i] + (share - Scalar(1) / Scalar(2)) / 4 : low + share * (high - low);
    }
    return clamped(q);
  }

  // No point beyond is reached, and none is so far that its square is out of range.
  [[nodiscard]] Point within_reach(const Point& x) const noexcept {
    const Scalar size = x.cwiseAbs().maxCoeff();
    if (!(size > reach_ / 2)) return x;
    const Point scaled = x / size;
    const Scalar distance = scaled.norm();
    return distance <= reach_ / size ? x : Point(scaled * (reach_ / distance));
  }

  [[nodiscard]] Joints clamped(const Joints& q) const noexcept { return q.cwiseMax(lower_).cwiseMin(upper_); }

  [[nodiscard]] static Joints fallback(const Joints& near) noexcept { return is_finite(near) ? near : Joints::Zero(); }

  [[nodiscard]] static InverseMotion<N, Scalar> at_rest(const Joints& q, Status status) noexcept {
    return {{q, Joints::Zero(), Joints::Zero()}, status};
  }

  [[nodiscard]] Scalar edge() const noexcept { return reach_ / 256; }  // of singular values, m
  [[nodiscard]] Scalar level() const noexcept {                        // of slopes that are taken as zero, m
    using std::sqrt;
    return sqrt(std::numeric_limits<Scalar>::epsilon()) * reach_;
  }

  SerialChain<N, Scalar> robot_;
  Joints lower_, upper_;
  Settings settings_;
  Scalar reach_;      // m
  Scalar tolerance_;  // roundings of a position, m
};

}  // namespace limpid
