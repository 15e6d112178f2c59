// SPDX-License-Identifier: MIT
#pragma once

#include "tick/simd_lanes.hpp"
#include "tick/straightforward_tick.hpp"

#include <cmath>

namespace limpid::bench {

/// The arm's part of `SimdTick`. Joints lie as {-, 2, 2 + 3, 1}: by the links' own angles both links have the same
/// equations with the other's angle, and the lane without a joint has angle 0, cosine 1, and takes theta's first entry.
class SimdArm {
  using Lanes = simd::Lanes;
  using Bits = simd::Bits;

 public:
  explicit SimdArm(const StraightforwardTick::Settings& s)
      : wall_{simd::axes(s.wall)},
        Lambda_{0, s.Lambda[1], s.Lambda[2], s.Lambda[0]},
        coupling_{0, 0, s.Lambda[1] - s.Lambda[2], 0},
        Kd_{0, s.Kd[1], s.Kd[2], s.Kd[0]},
        inertia_{{s.theta0[0], s.theta0[1], s.theta0[2], 0}, {s.Gamma[0], s.Gamma[1], s.Gamma[2], 0}},
        across_{{0, s.theta0[3], s.theta0[3], 0}, {0, s.Gamma[3], s.Gamma[3], 0}},
        weight_{{0, g * s.theta0[4], g * s.theta0[5], 0}, {0, g * g * s.Gamma[4], g * g * s.Gamma[5], 0}},
        friction_{{0, s.theta0[7], s.theta0[8], s.theta0[6]}, {0, s.Gamma[7], s.Gamma[8], s.Gamma[6]}} {}

  void set_step(double h) {
    for (Adapted* p : {&inertia_, &across_, &weight_, &friction_}) p->half_step = p->Gamma * (h / 2);
  }

  // (3.3)-(3.6), (3.12), (3.14), then (4.1), (4.3), (4.7), (4.8)
  [[gnu::always_inline]] Eigen::Vector3d track(const Lanes& x, const Lanes& v, const Lanes& a, const Eigen::Vector3d& q,
                                               const Eigen::Vector3d& qdot, const Lanes& F_h) {
    Lanes C, S, C_e, S_e, w_e, dw_e;
    simd::sine_cosine(Lanes{0, q[1], q[1] + q[2], q[0]}, S, C);
    inverse(x, v, a, C_e, S_e, w_e, dw_e);
    const Lanes sine = S * C_e - C * S_e, cosine = C * C_e + S * S_e;  // of q - q_e
    const Lanes t = sine / cosine, tt = t * t;
    Lanes e = t + t * tt * simd::polynomial(simd::arc_tangent_terms, tt);
    constexpr Lanes longest{1e300, 0.04, 0.04, 0.04};
    if (simd::any((tt > longest) | (Bits)cosine)) [[unlikely]] {
      simd::any_arc_tangent(sine, cosine, e);
    }
    const Lanes w{0, qdot[1], qdot[1] + qdot[2], qdot[0]}, de = w - w_e;
    const Lanes wr = w_e - Lambda_ * e - coupling_ * simd::spread<1>(e);
    const Lanes dwr = dw_e - Lambda_ * de - coupling_ * simd::spread<1>(de);
    return torque(C, S, w, wr, dwr, w - wr, F_h);
  }

 private:
  static constexpr double l2 = 0.135, l3 = 0.130, g = 9.81;
  static constexpr Lanes links{0, l2, l3, 0};

  /// theta' = -Gamma direction, by the trapezoidal rule
  struct Adapted {
    Lanes theta, Gamma, half_step{}, direction{};

    [[gnu::always_inline]] Lanes update(const Lanes& now) {
      theta -= half_step * (now + direction);
      direction = now;
      return theta;
    }
  };

  /// The other link's.
  [[gnu::always_inline]] static Lanes other(const Lanes& v) { return __builtin_shufflevector(v, v, 0, 2, 1, 3); }
  [[gnu::always_inline]] static Lanes with_joint1(const Lanes& v, const Lanes& joint1) {
    return __builtin_shufflevector(v, joint1, 0, 1, 2, 7);
  }
  /// From angles of links to angles of joints.
  [[gnu::always_inline]] static Lanes joints(const Lanes& v) { return v - Lanes{0, 0, 1, 0} * simd::spread<1>(v); }

  /// Of a vector on {x, y}: in the arm's plane and across it.
  [[gnu::always_inline]] static void turn(const Lanes& c1, const Lanes& s1, const Lanes& v, Lanes& along,
                                          Lanes& across) {
    const Lanes swapped = __builtin_shufflevector(v, v, 1, 0, 3, 2), part = c1 * v;
    along = simd::spread<0>(part + s1 * swapped);
    across = simd::spread<1>(part - s1 * swapped);
  }

  [[gnu::always_inline]] void inverse(const Lanes& x, const Lanes& v, const Lanes& a, Lanes& C, Lanes& S, Lanes& w,
                                      Lanes& dw) const {
    const Lanes p = x + wall_;
    const double level = p[0] * p[0] + p[1] * p[1], square = level + p[2] * p[2];
    constexpr double near = (l2 - l3) * (l2 - l3), far = (l2 + l3) * (l2 + l3);
    const Lanes r = simd::all(std::sqrt(level)), z = simd::spread<2>(p), square_ = simd::all(square);
    const Lanes bend = simd::all(std::sqrt((square - near) * (far - square)));  // -2 l2 l3 sin q3
    const Lanes c3 = (square_ - (l2 * l2 + l3 * l3)) * Lanes{0, 1 / (2 * l2 * l3), 1 / (2 * l2 * l3), 0};
    // cosines and sines times 2 l2 square, 2 l3 square, r
    const Lanes middle = square_ + Lanes{0, l2 * l2 - l3 * l3, l3 * l3 - l2 * l2, 0}, side = bend * Lanes{0, 1, -1, 0};
    const Lanes forward = with_joint1(r * middle - z * side, simd::spread<0>(p));
    const Lanes upward = with_joint1(z * middle + r * side, simd::spread<1>(p));
    const Lanes divisor = with_joint1(__builtin_shufflevector(square_, bend, 4, 1, 2, 3), r);
    const Lanes per = Lanes{1, 1 / (2 * l2), 1 / (2 * l3), 1} / divisor;
    C = forward * per;
    S = upward * per;
    const Lanes scale = with_joint1(simd::spread<0>(per) * Lanes{0, -2 * l3, 2 * l2, 0}, per);

    const Lanes C_o = other(C), S_o = other(S), c1 = simd::spread<3>(C), s1 = simd::spread<3>(S);
    Lanes along, across;
    turn(c1, s1, v, along, across);
    w = with_joint1(C_o * along + S_o * simd::spread<2>(v), across) * scale;
    const Lanes w1 = simd::spread<3>(w), pull = links * w * w, coriolis = (along + along) * w1;
    turn(c1, s1, a, along, across);
    const Lanes inward = along + r * w1 * w1;
    dw = with_joint1(C_o * inward + S_o * simd::spread<2>(a) + c3 * pull + other(pull), across - coriolis) * scale;
  }

  [[gnu::always_inline]] Eigen::Vector3d torque(const Lanes& C, const Lanes& S, const Lanes& w, const Lanes& wr,
                                                const Lanes& dwr, const Lanes& delta, const Lanes& F_h) {
    const Lanes C_o = other(C), S_o = other(S), SC_o = S * C_o;
    const Lanes c3 = C * C_o + S * S_o, s3 = SC_o - C * S_o;  // of the link's angle less the other's
    const Lanes w1 = simd::spread<3>(w), wr1 = simd::spread<3>(wr), dwr1 = simd::spread<3>(dwr);
    const Lanes d1 = simd::spread<3>(delta), turn1 = w1 * wr1;
    // Rows of (3.28): row 1 is `first` times C and C_o, rows 2 and 3 are `own` and `coupled`
    const Lanes first = C * dwr1 - S * (wr1 * w + w1 * wr), own = dwr + C * S * turn1;
    const Lanes coupled = SC_o * turn1 + other(c3 * dwr - s3 * (wr * w));
    const Lanes rate = joints(wr), error = joints(delta), first1 = first * d1, both = C_o * first1 + coupled * delta;

    const Lanes inertia = inertia_.update(C * first1 + own * delta), between = across_.update(both + other(both));
    const Lanes weight = weight_.update(C * delta), friction = friction_.update(rate * error);
    Lanes along, across;
    turn(simd::spread<3>(C), simd::spread<3>(S), F_h, along, across);
    const Lanes lift = simd::spread<2>(F_h);
    const Lanes joint1 = first * (C * inertia + C_o * between) - links * C * across;  // its sum
    const Lanes link = own * inertia + coupled * between + C * (weight - links * lift) + S * (links * along);
    const Lanes own_joint = friction * rate - Kd_ * error;
    const Lanes low = __builtin_shufflevector(joint1, link, 0, 4, 2, 6);
    const Lanes high = __builtin_shufflevector(joint1, link, 1, 5, 3, 7);
    const Lanes pairs = low + high, rest = pairs + __builtin_shufflevector(own_joint, own_joint, 3, 1, 2, 2);
    const Lanes tau = rest + __builtin_shufflevector(pairs, pairs, 2, 3, 0, 1);
    return {tau[0], tau[1], rest[3]};
  }

  Lanes wall_, Lambda_, coupling_, Kd_;
  Adapted inertia_, across_, weight_, friction_;
};

}  // namespace limpid::bench
