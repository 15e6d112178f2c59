// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/robot/joint_state.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace limpid {

/// Dahl's z after a path, in units of its z_s: dz = dx - |dx| z, solved. In [-1, 1], where z is.
/// @realtime  no allocation, no throw for built-in scalars; an exponential
template <Real Scalar>
[[nodiscard]] Scalar turned(const Scalar& z, const Scalar& path) noexcept {
  using std::abs, std::expm1;
  const Scalar end = path < Scalar(0) ? Scalar(-1) : Scalar(1), part = -expm1(-abs(path));
  return z + part * (end - z);
}

/// Friction of each joint: f_c sign(q') + f_v q'.
template <int Joints = 3, Real Scalar = double>
struct JointFriction {
  using Vector = Eigen::Array<Scalar, Joints, 1>;
  Vector coulomb = Vector::Zero();  ///< f_c, N m
  Vector viscous = Vector::Zero();  ///< f_v, beyond the robot's own B, N m s/rad
};

/// Of a FrictionIdentifier.
template <int Joints = 3, Real Scalar = double>
struct FrictionIdentifierSettings {
  using Vector = Eigen::Array<Scalar, Joints, 1>;
  Vector largest = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());  ///< of f_c, N m, > 0
  Vector largest_viscous = Vector::Zero();                             ///< of f_v, N m s/rad, >= 0; 0 holds it at 0
  Vector start = Vector::Zero();                                       ///< f_c at the start, N m, within [0, largest]
  Vector presliding = Vector::Constant(Scalar(5) / Scalar(10'000));    ///< z_s of the joint, rad, > 0
  Vector encoder_step = Vector::Constant(Scalar(4) / Scalar(10'000));  ///< motion within it is none, rad, >= 0
  Scalar bandwidth = Scalar(100);           ///< w of the VelocityObserver that the torque comes from, rad/s, > 0
  Scalar memory = Scalar(1);                ///< rad of motion after which what was learnt counts for 1/e, > 0
  Scalar prior = Scalar(2) / Scalar(1000);  ///< rad of motion that the start counts for, > 0
};

/// Coulomb and viscous friction of each joint, from the torque that brakes it: least squares in
///
///     torque = f_c W z + f_v W q',      0 <= f_c <= `largest`,      0 <= f_v <= `largest_viscous`
///
/// W = w^3/(s + w)^3 is the lag of the VelocityObserver from which the torque comes, and z Dahl's smooth sign of the
/// motion that was seen. Each piece of motion counts by its length, and forgets by it what came before: at rest, where
/// a joint's friction may be anything up to f_c, nothing is learnt or forgotten. Angles that jitter within an encoder
/// step are at rest.
/// @tparam Joints  number of joints
/// @realtime       no allocation, no throw; three exponentials a joint, some 40 flops
template <int Joints = 3, Real Scalar = double>
class FrictionIdentifier {
 public:
  using Vector = Eigen::Array<Scalar, Joints, 1>;
  using Settings = FrictionIdentifierSettings<Joints, Scalar>;

  /// @throws std::invalid_argument  where a setting cannot serve
  explicit FrictionIdentifier(const Settings& settings) : settings_{checked(settings)} {
    found_.coulomb = settings.start;
  }

  /// @param friction  torque against the joints beyond the robot's model, N m
  /// @return          not_finite, clock_backwards: the call changed nothing
  template <typename Derived>
  [[nodiscard]] Status update(Time now, const JointState<Joints, Scalar>& is,
                              const Eigen::DenseBase<Derived>& friction) noexcept {
    if (started_ && now <= now_) return Status::clock_backwards;
    if (!is_finite(is) || !is_finite(friction)) return Status::not_finite;
    using std::expm1;
    const Scalar part =
        started_ ? Scalar(-expm1(-settings_.bandwidth * in_seconds<Scalar>(elapsed(now, now_)))) : Scalar(1);
    std::array<Joint, std::size_t{Joints}> next = joint_;
    for (int i = 0; i < Joints; ++i) {
      Joint& joint = next[std::size_t(i)];
      learn(joint, i, move(joint, i, is.q[i]), is.qdot[i], friction.derived()(i), part);
      if (!in_range(joint)) return Status::not_finite;
    }
    joint_ = next;
    started_ = true;
    now_ = now;
    for (int i = 0; i < Joints; ++i) solve(i);
    return Status::ok;
  }

  [[nodiscard]] const JointFriction<Joints, Scalar>& friction() const noexcept { return found_; }

 private:
  // Sums of the least squares in units of the largest values: theta = f_c/largest and f_v/largest_viscous.
  struct Joint {
    Scalar q{0}, z{0};                         // middle of the band that the angle is in, Dahl's z
    std::array<Scalar, 3> z_lag{}, v_lag{};    // W z and W q', last
    Scalar zz{0}, zv{0}, vv{0}, zy{0}, vy{0};  // information, (N m)^2 rad
  };

  static const Settings& checked(const Settings& s) {
    const auto positive = [](const auto& v) { return is_finite(v) && (v > Scalar(0)).all(); };
    expect(positive(s.largest), "FrictionIdentifier: largest", "finite and > 0", s.largest);
    expect(is_finite(s.largest_viscous) && (s.largest_viscous >= Scalar(0)).all(),
           "FrictionIdentifier: largest_viscous", "finite and >= 0", s.largest_viscous);
    expect((s.start >= Scalar(0)).all() && (s.start <= s.largest).all(), "FrictionIdentifier: start", "of [0, largest]",
           s.start);
    expect(positive(s.presliding), "FrictionIdentifier: presliding", "finite and > 0", s.presliding);
    expect(is_finite(s.encoder_step) && (s.encoder_step >= Scalar(0)).all(), "FrictionIdentifier: encoder_step",
           "finite and >= 0", s.encoder_step);
    check_positive(s.bandwidth, "FrictionIdentifier: bandwidth");
    check_positive(s.memory, "FrictionIdentifier: memory");
    check_positive(s.prior, "FrictionIdentifier: prior");
    expect(positive(Vector(s.prior * s.largest.square())), "FrictionIdentifier: largest", "a square in range",
           s.largest);
    return s;
  }

  static void check_positive(const Scalar& value, const char* name) {
    expect(is_finite(value) && value > Scalar(0), name, "finite and > 0", value);
  }

  static const Scalar& lagged(std::array<Scalar, 3>& lag, const Scalar& input, const Scalar& part) noexcept {
    lag[0] += part * (input - lag[0]);
    lag[1] += part * (lag[0] - lag[1]);
    lag[2] += part * (lag[1] - lag[2]);
    return lag[2];
  }

  // Takes the angle in; the way that the joint moved, rad.
  [[nodiscard]] Scalar move(Joint& joint, int i, const Scalar& q) const noexcept {
    using std::abs;
    const Scalar half = settings_.encoder_step[i] / Scalar(2);
    const Scalar middle = started_ ? std::clamp(joint.q, Scalar(q - half), Scalar(q + half)) : q;
    const Scalar path = started_ ? Scalar(middle - joint.q) : Scalar(0);
    joint.q = middle;
    joint.z = turned(joint.z, Scalar(path / settings_.presliding[i]));
    return abs(path);
  }

  void learn(Joint& joint, int i, const Scalar& length, const Scalar& qdot, const Scalar& torque,
             const Scalar& part) const noexcept {
    using std::exp;
    const Scalar z = settings_.largest[i] * lagged(joint.z_lag, joint.z, part);
    const Scalar v = settings_.largest_viscous[i] * lagged(joint.v_lag, qdot, part);
    if (length == Scalar(0)) return;
    const Scalar kept = exp(-length / settings_.memory), weight = settings_.memory * (Scalar(1) - kept);
    joint.zz = kept * joint.zz + weight * z * z;
    joint.zv = kept * joint.zv + weight * z * v;
    joint.vv = kept * joint.vv + weight * v * v;
    joint.zy = kept * joint.zy + weight * z * torque;
    joint.vy = kept * joint.vy + weight * v * torque;
  }

  // Whether nothing that is kept can make a later number infinite.
  [[nodiscard]] static bool in_range(const Joint& joint) noexcept {
    using std::abs;
    const Scalar bound = std::numeric_limits<Scalar>::max() / Scalar(1'000'000);
    return abs(joint.q) < bound && joint.v_lag[0] * joint.v_lag[0] < bound && abs(joint.zz) + abs(joint.vv) < bound &&
           abs(joint.zy) + abs(joint.vy) < bound;
  }

  // The smallest sum of squares on the unit square, with the prior.
  void solve(int i) noexcept {
    const Joint& joint = joint_[std::size_t(i)];
    const Scalar F = settings_.largest[i], prior = settings_.prior * F * F;
    const Scalar a = joint.zz + prior, b = joint.zv, c = joint.vv + prior;
    const Scalar p = joint.zy + prior * settings_.start[i] / F, r = joint.vy;
    const auto unit = [](const Scalar& x) { return std::clamp(x, Scalar(0), Scalar(1)); };
    const Scalar determinant = a * c - b * b;
    Scalar x = (c * p - b * r) / determinant, y = (a * r - b * p) / determinant;
    if (!(x == unit(x) && y == unit(y))) {
      const auto cost = [&](const Scalar& s, const Scalar& t) {
        return a * s * s + Scalar(2) * b * s * t + c * t * t - Scalar(2) * (p * s + r * t);
      };
      Scalar least = std::numeric_limits<Scalar>::infinity();
      const auto offer = [&](const Scalar& s, const Scalar& t) {
        if (!(cost(s, t) < least)) return;
        least = cost(s, t);
        x = s;
        y = t;
      };
      for (const Scalar& edge : {Scalar(0), Scalar(1)}) {
        offer(edge, unit(Scalar((r - b * edge) / c)));
        offer(unit(Scalar((p - b * edge) / a)), edge);
      }
    }
    found_.coulomb[i] = x * F;
    found_.viscous[i] = y * settings_.largest_viscous[i];
  }

  Settings settings_;
  bool started_ = false;
  Time now_{};
  std::array<Joint, std::size_t{Joints}> joint_{};
  JointFriction<Joints, Scalar> found_{};
};

}  // namespace limpid
