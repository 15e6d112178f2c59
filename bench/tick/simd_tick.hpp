// SPDX-License-Identifier: MIT
#pragma once

#include "tick/simd_arm.hpp"
#include "tick/straightforward_tick.hpp"

#include <limpid/core/inverse_factorial.hpp>
#include <limpid/estimation/information_series.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace limpid::bench {

/// The tick by hand, for speed alone: what any other form is measured against. Three axes lie in the four lanes of one
/// register, the last one twice; sines and arc tangents of all joints are taken at once; sparsity is used, nothing is
/// computed twice, nothing is checked. Same laws as `StraightforwardTick`, hence the same torques.
class SimdTick {
  using Lanes = simd::Lanes;

 public:
  using Settings = StraightforwardTick::Settings;

  explicit SimdTick(const Settings& s)
      : s_{s},
        series_{s.alpha * s.nu},
        arm_{s},
        k_{simd::all(s.initial[0])},
        b_{simd::all(s.initial[1])},
        D0_{simd::all(s.initial_gain[0])},
        D1_{simd::all(s.initial_gain[1])} {}

  [[gnu::always_inline]] Eigen::Vector3d step(Time now, const Eigen::Vector3d& F_h, const ToolState<3>& tool,
                                              const Eigen::Vector3d& q, const Eigen::Vector3d& qdot) {
    const Lanes F = simd::axes(F_h);
    if (started_) {
      if (now - now_ != step_) [[unlikely]]
        set_step(now - now_);
      predict(F);
      if (arrived_ != 0) adapt();
    }
    sample(now, tool);
    kappa_ = k_ * c_.per_mass + c_.tool_kappa;
    beta_ = b_ * c_.per_mass + c_.tool_beta;
    const Lanes a = (F + seen().feedback) * c_.per_mass - kappa_ * x_ - beta_ * v_;
    started_ = true;
    now_ = now;
    F_h_ = F;
    return arm_.track(x_, v_, a, q, qdot, F);
  }

  /// Of an axis: (k, b), and Gamma multiplied out.
  [[nodiscard]] Eigen::Vector2d theta(int axis) const { return {k_[axis], b_[axis]}; }
  [[nodiscard]] Eigen::Matrix2d Gamma(int axis) const {
    const double across = U_[axis] * D1_[axis];
    Eigen::Matrix2d Gamma;
    Gamma << D0_[axis] + U_[axis] * across, across, across, D1_[axis];
    return Gamma;
  }

 private:
  static constexpr std::size_t most_on_the_way = 64;

  struct Sampled {
    Lanes x{}, v{}, force{}, feedback{};  // L e_zd
  };

  /// The newest one that is known.
  [[gnu::always_inline]] const Sampled& seen() const { return on_the_way_[(arrived_ - 1) % most_on_the_way]; }

  [[gnu::always_inline]] void sample(Time now, const ToolState<3>& tool) {
    if (now >= due_) {
      const std::size_t at = sent_++ % most_on_the_way;
      const Lanes x = simd::axes(tool.x), v = simd::axes(tool.v);
      on_the_way_[at] = {x, v, simd::axes(tool.force), c_.L1 * (x_ - x) + c_.L2 * (v_ - v)};
      arrives_[at] = now + s_.delay;
      due_ += s_.period;
      if (due_ <= now) [[unlikely]]
        due_ = s_.period * (now / s_.period + 1);
    }
    while (arrived_ != sent_ && arrives_[arrived_ % most_on_the_way] <= now) ++arrived_;
  }

  void set_step(Duration step) {
    step_ = step;
    const double h = in_seconds(step), per_mass = 1 / s_.tool.mass, growth = 1 + std::expm1(s_.alpha * h);
    c_.h = simd::all(h);
    c_.per_h = simd::all(1 / h);
    c_.hh = simd::all(h * h);
    c_.hh_per_mass = simd::all(h * h * per_mass);
    c_.growth = simd::all(growth);
    c_.tau = simd::all((growth - 1) / s_.alpha);
    c_.most_trace = simd::all(s_.rho_M / growth);
    const double B = (s_.upper[1] + s_.tool.damping) * per_mass * h;
    const double K = (s_.upper[0] + s_.tool.stiffness) * per_mass * h * h;
    short_step_ = B + std::sqrt(B * B + 4 * K) <= 0.9;
    arm_.set_step(h);
  }

  // (4.44)-(4.47), exact for a held sample; Gamma = U D U'.
  [[gnu::always_inline]] void adapt() {
    const Lanes &phi_x = seen().x, &phi_v = seen().v;
    const Lanes f1 = phi_v + U_ * phi_x, v0 = D0_ * phi_x, v1 = D1_ * f1, s0 = phi_x * v0, s1 = f1 * v1;
    const Lanes s = s0 + s1, inverse = 1 / (1 + c_.nu * s), scale = c_.tau * inverse, z = s * scale;
    const Lanes u = scale * information(z, inverse);
    const Lanes first = 1 + u * s0, both = first + u * s1, per_first = 1 / first, per_both = 1 / both;
    const Lanes gain = (phi_x * k_ + phi_v * b_ - seen().force) * (u * per_both);
    const Lanes k = k_ - (v0 + U_ * v1) * gain, b = b_ - v1 * gain, trace = D0_ + D1_ * (1 + U_ * U_);
    if (simd::any((z > c_.most_z) | (trace > c_.most_trace) | (k < c_.lower_k) | (k > c_.upper_k) | (b < c_.lower_b) |
                  (b > c_.upper_b))) [[unlikely]] {
      for (int i = 0; i < 4; ++i) adapt_slowly(i);
      return;
    }
    k_ = k;
    b_ = b;
    U_ -= (u * v0) * (f1 * per_first);
    D0_ *= c_.growth * per_first;
    D1_ *= c_.growth * (first * per_both);
  }

  [[gnu::always_inline]] Lanes information(const Lanes& z, const Lanes& inverse) const {
    using limpid::detail::load, limpid::detail::stored;
    Lanes value;
    load(value, series_(stored<Eigen::Array4d>(z), stored<Eigen::Array4d>(inverse)));
    return value;
  }

  // With less forgetting, by any step, and back into the box.
  [[gnu::noinline, gnu::cold]] void adapt_slowly(int i) {
    double k = k_[i], b = b_[i], U = U_[i], D0 = D0_[i], D1 = D1_[i];
    const double phi_x = seen().x[i], phi_v = seen().v[i], epsilon = phi_x * k + phi_v * b - seen().force[i];
    const double tr = D0 + D1 * (1 + U * U), largest = tr / 2 + std::sqrt(std::max(0.0, tr * tr / 4 - D0 * D1));
    double alpha = s_.alpha, T = c_.growth[i];
    if (T * largest > s_.rho_M) {
      T = std::max(1.0, s_.rho_M / largest);
      alpha = std::log(T) / c_.h[i];
    }
    const double f1 = phi_v + U * phi_x, v0 = D0 * phi_x, v1 = D1 * f1, s = phi_x * v0 + f1 * v1;
    const double tau = alpha > 0 ? (T - 1) / alpha : c_.h[i];
    const double u = StraightforwardTick::information(tau, alpha * s_.nu, s_.nu, s);
    const double first = 1 + u * phi_x * v0, both = 1 + u * s;
    k -= (v0 + U * v1) * (u * epsilon / both);
    b -= v1 * (u * epsilon / both);
    U -= v0 * u * f1 / first;
    D0 *= T / first;
    D1 *= T * first / both;

    const double across = U * D1, k_in = std::clamp(k, s_.lower[0], s_.upper[0]);
    b += across * ((k_in - k) / (D0 + U * across));
    const double b_in = std::clamp(b, s_.lower[1], s_.upper[1]);
    k_[i] = std::clamp(k_in + across * ((b_in - b) / D1), s_.lower[0], s_.upper[0]);
    b_[i] = b_in;
    U_[i] = U;
    D0_[i] = D0;
    D1_[i] = D1;
  }

  // Exact step of (4.25): r and s, answers to the unit ramp and step over h^3 and h^2, by their series,
  // `SecondOrderStep` backwards; its longer form for |b h|, sqrt(k) h <= 1/2. Velocities times h, accelerations times
  // h^2.
  [[gnu::always_inline]] void predict(const Lanes& F_h) {
    const Lanes B = beta_ * c_.h, K = kappa_ * c_.hh;
    Lanes r, s;
    if (short_step_) [[likely]]
      sum<12>(B, K, r, s);
    else
      sum<15>(B, K, r, s);
    const Lanes gain = 1 - K * r - B * s, v = v_ * c_.h;
    const Lanes f = (F_h_ + seen().feedback) * c_.hh_per_mass, slope = (F_h - F_h_) * c_.hh_per_mass;
    const Lanes pull = f - K * x_;
    x_ += r * slope + s * pull + gain * v;
    v_ = (v + s * (slope - K * v) + gain * (pull - B * v)) * c_.per_h;
  }

  template <int terms>
  [[gnu::always_inline]] static void sum(const Lanes& B, const Lanes& K, Lanes& r, Lanes& s) {
    r = Lanes{};
    s = simd::all(limpid::detail::inverse_factorial<double, terms + 2>());
    add_terms<terms - 2>(B, K, r, s);
  }
  template <int n>
  [[gnu::always_inline]] static void add_terms(const Lanes& B, const Lanes& K, Lanes& before, Lanes& last) {
    const Lanes next = (limpid::detail::inverse_factorial<double, n + 3>() - K * before) - B * last;
    before = last;
    last = next;
    if constexpr (n > -1) add_terms<n - 1>(B, K, before, last);
  }

  /// Constants, some of them while the step is one length; in all lanes, so that the processor loads none apart.
  struct Constants {
    Lanes per_mass, tool_kappa, tool_beta, L1, L2, nu, lower_k, upper_k, lower_b, upper_b, most_z;
    Lanes h{}, per_h{}, hh{}, hh_per_mass{}, growth{}, tau{}, most_trace{};
  };

  Settings s_;
  InformationSeries<Eigen::Array4d> series_;
  Constants c_{simd::all(1 / s_.tool.mass),
               simd::all(s_.tool.stiffness / s_.tool.mass),
               simd::all(s_.tool.damping / s_.tool.mass),
               simd::all(s_.L1),
               simd::all(s_.L2),
               simd::all(s_.nu),
               simd::all(s_.lower[0]),
               simd::all(s_.upper[0]),
               simd::all(s_.lower[1]),
               simd::all(s_.upper[1]),
               simd::all(series_.most())};
  SimdArm arm_;
  Lanes k_, b_, D0_, D1_, U_{}, kappa_{}, beta_{}, x_{}, v_{}, F_h_{};
  Time now_{}, due_{};
  Duration step_{};
  bool started_ = false, short_step_ = false;
  std::size_t sent_ = 0, arrived_ = 0;
  std::array<Sampled, most_on_the_way> on_the_way_{};
  std::array<Time, most_on_the_way> arrives_{};
};

}  // namespace limpid::bench
