// SPDX-License-Identifier: MIT
#pragma once

#include "tick/straightforward_tick.hpp"

#include <limpid/core/lane_math.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace limpid::bench {

/// The tick by hand, for speed alone: what any other form is measured against. Three axes lie in the four lanes of one
/// register, the last one twice; sines and arc tangents of all joints are taken at once; sparsity is used, nothing is
/// computed twice, nothing is checked. Same laws as `StraightforwardTick`, hence the same torques.
class SimdTick {
  using Lanes = detail::Doubles<4>::Value;

 public:
  using Settings = StraightforwardTick::Settings;

  explicit SimdTick(const Settings& s)
      : s_{s},
        k_{all(s.initial[0])},
        b_{all(s.initial[1])},
        held_k_{k_},
        held_b_{b_},
        D0_{all(s.initial_gain[0])},
        D1_{all(s.initial_gain[1])} {
    for (std::size_t i = 0; i < 9; ++i) theta_[i] = s.theta0[static_cast<Eigen::Index>(i)];
  }

  [[gnu::always_inline]] Eigen::Vector3d step(Time now, const Eigen::Vector3d& F_h, const ToolState<3>& tool,
                                              const Eigen::Vector3d& q, const Eigen::Vector3d& qdot) {
    const double h = started_ ? in_seconds(now - now_) : 0;
    const Lanes F = lanes(F_h);
    const bool fresh = sample(now, tool);
    if (started_) {
      if (h != h_) set_step(h);
      predict(F);
      if (sampled_) adapt();
    }
    if (fresh) take_over();
    held_k_ = k_;
    held_b_ = b_;
    times_[next_] = now;
    past_[next_] = {x_, v_};
    next_ = (next_ + 1) % history;
    if (fresh) compare();
    const Lanes a = (F + feedback_ - (held_k_ + s_.tool.stiffness) * x_ - (held_b_ + s_.tool.damping) * v_) * per_mass_;
    const Eigen::Vector3d tau = track(a, q, qdot, F_h);
    started_ = true;
    now_ = now;
    F_h_ = F;
    return tau;
  }

 private:
  static constexpr std::size_t history = 512;
  static constexpr double l2 = 0.135, l3 = 0.130, g = 9.81, rho = 1 / 64.0;

  struct Sampled {
    Time taken{};
    Lanes x{}, v{}, force{};
  };
  struct Past {
    Lanes x{}, v{};
  };

  static Lanes all(double value) { return Lanes{} + value; }
  template <typename Vector>
  [[gnu::always_inline]] static Lanes lanes(const Vector& v) {
    return Lanes{v[0], v[1], v[2], v[2]};
  }
  static bool any(const Lanes& above, double bound) { return std::max(std::max(above[0], above[1]), above[2]) > bound; }

  bool sample(Time now, const ToolState<3>& tool) {
    if (now >= due_) {
      on_the_way_[sent_++ % 64] = {now, lanes(tool.x), lanes(tool.v), lanes(tool.force)};
      due_ = due_ + s_.period > now ? due_ + s_.period : s_.period * (now / s_.period + 1);
    }
    bool fresh = false;
    for (; arrived_ < sent_ && on_the_way_[arrived_ % 64].taken + s_.delay <= now; ++arrived_) fresh = true;
    return fresh;
  }

  void take_over() {
    const Sampled& seen = on_the_way_[(arrived_ - 1) % 64];
    taken_ = seen.taken;
    phi_x_ = seen.x;
    phi_v_ = seen.v;
    F_ = seen.force;
    sampled_ = true;
  }

  // e_zd and L e_zd; the newest entries are the likely ones.
  [[gnu::always_inline]] void compare() {
    std::size_t at = (next_ + history - 1) % history;
    while (times_[at] != taken_) at = (at + history - 1) % history;
    feedback_ = s_.L1 * (past_[at].x - phi_x_) + s_.L2 * (past_[at].v - phi_v_);
  }

  void set_step(double h) {
    h_ = h;
    per_h_ = 1 / h;
    growth_ = 1 + std::expm1(s_.alpha * h);
    tau_ = (growth_ - 1) / s_.alpha;
  }

  // (e^x - 1)/x for |x| <= 1/64
  [[gnu::always_inline]] static void mean(const Lanes& x, Lanes& e) {
    const Lanes xx = x * x;
    e = (1 + x * 0.5) + xx * ((1.0 / 6 + x * (1.0 / 24)) + xx * ((1.0 / 120 + x * (1.0 / 720)) + xx * (1.0 / 5040)));
  }

  // (4.44)-(4.47), exact for a held sample; Gamma = U D U'.
  [[gnu::always_inline]] void adapt() {
    const double p = s_.alpha * s_.nu;
    const Lanes f1 = phi_v_ + U_ * phi_x_, v0 = D0_ * phi_x_, v1 = D1_ * f1, s = phi_x_ * v0 + f1 * v1;
    const Lanes w = 1 + s_.nu * s, inverse = 1 / w, z = s * tau_ * inverse;
    Lanes u, growth = all(growth_);
    const Lanes trace = D0_ + D1_ * (1 + U_ * U_);
    if (any(z, rho) || any(trace, s_.rho_M / growth_)) [[unlikely]] {
      adapt_slowly(s, u, growth);
    } else {
      const Lanes a2 = (inverse + p) * 0.5, a3 = ((1 + p) * inverse + p * p) * (1.0 / 6);
      const Lanes a4 = ((1 + p + p * p) * inverse + p * p * p) * (1.0 / 24), c2 = 2 * a2 * a2 - a3;
      const Lanes ratio = 1 + z * (z * (c2 + z * (5 * a2 * (a3 - a2 * a2) - a4)) - a2);
      const Lanes l = z * ratio, pl = p * l;
      Lanes slow, fast;
      mean(pl, slow);
      mean(l - pl, fast);
      const Lanes grown = 1 + pl * slow;
      fast *= grown;
      const Lanes step = (w - ratio * (fast + (w - 1) * slow)) / (l * fast + w * grown);
      const Lanes here = ratio * (fast + p * (slow - fast));
      u = tau_ * inverse * (here + (1 + z * here) * step);
    }
    const Lanes first = 1 + u * (phi_x_ * v0), both = first + u * (f1 * v1);
    const Lanes per_first = 1 / first, per_both = 1 / both, epsilon = phi_x_ * k_ + phi_v_ * b_ - F_;
    const Lanes gain = u * per_both * epsilon;
    k_ -= (v0 + U_ * v1) * gain;
    b_ -= v1 * gain;
    U_ -= v0 * per_first * (u * f1);
    D0_ *= growth * per_first;
    D1_ *= growth * (first * per_both);
    project();
  }

  [[gnu::noinline]] void adapt_slowly(const Lanes& s, Lanes& u, Lanes& growth) const {
    for (int i = 0; i < 4; ++i) {
      const double U = U_[i], D0 = D0_[i], D1 = D1_[i], tr = D0 + D1 * (1 + U * U), det = D0 * D1;
      const double largest = tr / 2 + std::sqrt(std::max(0.0, tr * tr / 4 - det));
      double alpha = s_.alpha, T = growth_;
      if (T * largest > s_.rho_M) {
        T = std::max(1.0, s_.rho_M / largest);
        alpha = std::log(T) / h_;
      }
      growth[i] = T;
      u[i] = StraightforwardTick::information(alpha > 0 ? (T - 1) / alpha : h_, alpha * s_.nu, s_.nu, s[i]);
    }
  }

  [[gnu::always_inline]] void project() {
    const Lanes far = all(0), low_k = s_.lower[0] - k_, low_b = s_.lower[1] - b_;
    const Lanes high_k = k_ - s_.upper[0], high_b = b_ - s_.upper[1];
    const Lanes out_k = low_k > high_k ? low_k : high_k, out_b = low_b > high_b ? low_b : high_b;
    if (any(out_k > out_b ? out_k : out_b, far[0])) [[unlikely]]
      project_slowly();
  }

  [[gnu::noinline]] void project_slowly() {
    for (int i = 0; i < 4; ++i) {
      const double U = U_[i], D0 = D0_[i], D1 = D1_[i], across = U * D1, kk = D0 + U * across;
      const double k = std::clamp(k_[i], s_.lower[0], s_.upper[0]);
      b_[i] += across * ((k - k_[i]) / kk);
      const double b = std::clamp(b_[i], s_.lower[1], s_.upper[1]);
      k_[i] = std::clamp(k + across * ((b - b_[i]) / D1), s_.lower[0], s_.upper[0]);
      b_[i] = b;
    }
  }

  // Exact step of (4.25): r and s, answers to the unit ramp and step, by their series for |b h|, sqrt(k) h <= 1/2.
  [[gnu::always_inline]] void predict(const Lanes& F_h) {
    const Lanes kappa = (held_k_ + s_.tool.stiffness) * per_mass_, beta = (held_b_ + s_.tool.damping) * per_mass_;
    const Lanes B = beta * -h_, K = kappa * (-h_ * h_);
    Lanes older{}, newer = all(1), r = all(1.0 / 6), s = all(0.5);
    constexpr std::array inverse{
        1.0 / 24,          1.0 / 120,           1.0 / 720,           1.0 / 5040,      1.0 / 40320,
        1.0 / 362880,      1.0 / 3628800,       1.0 / 39916800,      1.0 / 479001600, 1.0 / 6227020800,
        1.0 / 87178291200, 1.0 / 1307674368000, 1.0 / 20922789888000};
    double before = 1.0 / 6;
#pragma GCC unroll 16
    for (const double factor : inverse) {
      const Lanes next = B * newer + K * older;
      r += factor * next;
      s += before * next;
      before = factor;
      older = newer;
      newer = next;
    }
    const Lanes gain = (1 + (B * s + K * r)) * h_, S = s * (h_ * h_), R = r * (h_ * h_ * h_);
    const Lanes f = (F_h_ + feedback_) * per_mass_, slope = (F_h - F_h_) * (per_mass_ * per_h_);
    const Lanes x = (1 - kappa * S) * x_ + gain * v_ + S * f + R * slope;
    v_ = (1 - beta * gain - kappa * S) * v_ - kappa * gain * x_ + gain * f + S * slope;
    x_ = x;
  }

  // (3.3)-(3.6), (3.12), (3.14), then (4.1), (4.3), (4.7), (4.8)
  [[gnu::always_inline]] Eigen::Vector3d track(const Lanes& a, const Eigen::Vector3d& q, const Eigen::Vector3d& qdot,
                                               const Eigen::Vector3d& F_h) {
    const double x0 = x_[0] + s_.wall[0], x1 = x_[1] + s_.wall[1], z = x_[2] + s_.wall[2];
    const double level = x0 * x0 + x1 * x1, r = std::sqrt(level), square = level + z * z;
    const double cosine = square - (l2 * l2 + l3 * l3);
    const double sine = -std::sqrt((square - (l2 - l3) * (l2 - l3)) * ((l2 + l3) * (l2 + l3) - square));
    constexpr double per = 1 / (2 * l2 * l3);
    const double c3 = cosine * per, s3 = sine * per, along = l2 + l3 * c3, across = -l3 * s3;
    const double forward = r * along - z * across, upward = z * along + r * across;
    Lanes q_e, sines, cosines;
    detail::arc_tangent<double, 4>(Lanes{x1, upward, sine, sine}, Lanes{x0, forward, cosine, cosine}, q_e);
    detail::sine_cosine<double, 4>(Lanes{q[0], q[1], q[1] + q[2], q[1] + q[2]}, sines, cosines);
    const double per_r = 1 / r, per_square = 1 / square, per_det = 2 / sine;
    const double c1 = x0 * per_r, s1 = x1 * per_r, c2 = forward * per_square, s2 = upward * per_square;
    const double c23 = c2 * c3 - s2 * s3, s23 = s2 * c3 + c2 * s3;
    const double v_r = c1 * v_[0] + s1 * v_[1], v_z = v_[2];
    const double w1 = (c1 * v_[1] - s1 * v_[0]) * per_r, w2 = (c23 * v_r + s23 * v_z) * l3 * per_det;
    const double w3 = -(r * v_r + z * v_z) * per_det, w23 = w2 + w3;
    const double link2 = l2 * w2 * w2, link3 = l3 * w23 * w23, rdot = -z * w2 - l3 * s23 * w3;
    const double a_r = c1 * a[0] + s1 * a[1] + r * w1 * w1 + link2 * c2 + link3 * c23;
    const double a_z = a[2] + link2 * s2 + link3 * s23;
    const Lanes qdot_e{w1, w2, w3, w3};
    const double joint3 = -(r * a_r + z * a_z) * per_det;
    const Lanes qddot_e{(c1 * a[1] - s1 * a[0] - 2 * rdot * w1) * per_r, (c23 * a_r + s23 * a_z) * l3 * per_det, joint3,
                        joint3};
    const Lanes Lambda = lanes(s_.Lambda), is = lanes(qdot);
    const Lanes vr = qdot_e - Lambda * (lanes(q) - q_e), ar = qddot_e - Lambda * (is - qdot_e), delta = is - vr;
    return torque(cosines, sines, qdot, vr, ar, delta, F_h);
  }

  [[gnu::always_inline]] Eigen::Vector3d torque(const Lanes& cosines, const Lanes& sines, const Eigen::Vector3d& v,
                                                const Lanes& vr, const Lanes& ar, const Lanes& delta,
                                                const Eigen::Vector3d& F_h) {
    const double c1 = cosines[0], s1 = sines[0], c2 = cosines[1], s2 = sines[1], c23 = cosines[2], s23 = sines[2];
    const double c3 = c2 * c23 + s2 * s23, s3 = c2 * s23 - s2 * c23, s223 = s2 * c23 + c2 * s23;
    const double v1 = vr[0], v2 = vr[1], v3 = vr[2], a1 = ar[0], a2 = ar[1], a3 = ar[2];
    const double d1 = delta[0], d2 = delta[1], d3 = delta[2], d23 = d2 + d3;
    const double turn2 = v1 * v[1] + v[0] * v2, turn3 = v1 * v[2] + v[0] * v3, turn1 = v[0] * v1;
    const double p12 = c2 * (c2 * a1 - s2 * turn2), p13 = c23 * (c23 * a1 - s23 * (turn2 + turn3));
    const double p14 = 2 * c2 * c23 * a1 - s223 * turn2 - c2 * s23 * turn3, p22 = a2 + c2 * s2 * turn1;
    const double p23 = a2 + a3 + c23 * s23 * turn1;
    const double p24 = c3 * (2 * a2 + a3) + s223 * turn1 - s3 * ((v2 + v3) * v[2] + v[1] * v3);
    const double p34 = c3 * a2 + c2 * s23 * turn1 + s3 * v[1] * v2, p25 = g * c2, p26 = g * c23;
    const std::array direction{a1 * d1,
                               p12 * d1 + p22 * d2,
                               p13 * d1 + p23 * d23,
                               p14 * d1 + p24 * d2 + p34 * d3,
                               p25 * d2,
                               p26 * d23,
                               v1 * d1,
                               v2 * d2,
                               v3 * d3};
    const double half = started_ ? h_ / 2 : 0;
    for (std::size_t i = 0; i < 9; ++i) {
      theta_[i] -= half * s_.Gamma[static_cast<Eigen::Index>(i)] * (direction[i] + direction_[i]);
      direction_[i] = direction[i];
    }
    const double r = l2 * c2 + l3 * c23, z = l2 * s2 + l3 * s23, along = c1 * F_h[0] + s1 * F_h[1];
    const auto& t = theta_;
    return {
        a1 * t[0] + p12 * t[1] + p13 * t[2] + p14 * t[3] + v1 * t[6] - s_.Kd[0] * d1 - r * (c1 * F_h[1] - s1 * F_h[0]),
        p22 * t[1] + p23 * t[2] + p24 * t[3] + p25 * t[4] + p26 * t[5] + v2 * t[7] - s_.Kd[1] * d2 -
            (r * F_h[2] - z * along),
        p23 * t[2] + p34 * t[3] + p26 * t[5] + v3 * t[8] - s_.Kd[2] * d3 - l3 * (c23 * F_h[2] - s23 * along)};
  }

  Settings s_;
  double per_mass_ = 1 / s_.tool.mass, h_ = 0, per_h_ = 0, growth_ = 1, tau_ = 0;
  Lanes k_, b_, held_k_, held_b_, D0_, D1_, U_{}, phi_x_{}, phi_v_{}, F_{}, x_{}, v_{}, feedback_{}, F_h_{};
  std::array<double, 9> theta_{}, direction_{};
  Time now_{}, due_{}, taken_{};
  bool started_ = false, sampled_ = false;
  std::size_t next_ = 0, sent_ = 0, arrived_ = 0;
  std::array<Sampled, 64> on_the_way_{};
  std::array<Time, history> times_{};
  std::array<Past, history> past_{};
};

}  // namespace limpid::bench
