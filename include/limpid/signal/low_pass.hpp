// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>

#include <Eigen/Core>

#include <limits>

namespace limpid {

/// First-order low-pass:
///
///     G(s) = 1 / (tau s + 1),     tau = 1 / (2 pi cutoff)
///
/// The input is taken as linear between ticks; for that law the step is exact at any spacing of the ticks:
///
///     y(t + h) = y + p (u - y) + (1 - p tau/h) (u(t + h) - u),     p = 1 - exp(-h/tau)
///
/// @tparam Axes  number of independent axes
/// @realtime     no allocation, no throw; 6 flops an axis, an exponential where h is not the last tick's
template <int Axes = 1, Real Scalar = double>
class LowPass {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  struct Settings {
    Scalar cutoff{};  ///< where the gain is 1/sqrt(2), Hz, > 0
  };

  struct Output {
    Vector value;   ///< y, in the input's unit; always finite
    Status status;  ///< `not_finite` or `clock_backwards`: the call changed nothing
  };

  /// @throws std::invalid_argument  where the cutoff is not positive and finite
  explicit LowPass(const Settings& settings) {
    using std::atan;
    expect(is_finite(settings.cutoff) && settings.cutoff > Scalar{0}, "LowPass: cutoff", "finite and > 0",
           settings.cutoff);
    corner_ = Scalar{8} * atan(Scalar{1}) * settings.cutoff;
  }

  /// Takes the input `u` of the tick `now`. The first call starts the filter at rest at `u`.
  [[nodiscard]] Output update(Time now, const Vector& u) noexcept {
    if (!is_finite(u)) return {y_, Status::not_finite};
    if (!started_) {
      y_ = u;
    } else {
      if (now <= now_) return {y_, Status::clock_backwards};
      if (elapsed(now, now_) != step_) set_step(elapsed(now, now_));
      const Vector y = y_ + part_ * (u_ - y_) + rise_ * (u - u_);
      if (!is_finite(y)) return {y_, Status::not_finite};  // a finite input may still jump too far
      y_ = y;
    }
    started_ = true;
    now_ = now;
    u_ = u;
    return {y_, Status::ok};
  }

 private:
  void set_step(Duration step) noexcept {
    using std::expm1;
    const Scalar angle = in_seconds<Scalar>(step) * corner_;  // h/tau
    step_ = step;
    part_ = -expm1(-angle);
    rise_ = angle > Scalar{1} ? Scalar(Scalar{1} - part_ / angle) : rise_series(angle);
  }

  // 1 - (1 - exp(-a))/a = a/2! - a^2/3! + a^3/4! - ..., which as a difference would cancel for a small a; a <= 1.
  static Scalar rise_series(const Scalar& angle) noexcept {
    using std::abs;
    const Scalar negligible = std::numeric_limits<Scalar>::epsilon() / Scalar{4};
    Scalar term = angle / Scalar{2}, sum = term;
    for (int n = 3; abs(term) > negligible * sum; ++n) {
      term *= -angle / Scalar(n);
      sum += term;
    }
    return sum;
  }

  Scalar corner_{0};  // 1/tau, rad/s
  Duration step_{};   // for which part_ and rise_ are
  Scalar part_{0};    // p
  Scalar rise_{0};    // 1 - p tau/h
  bool started_ = false;
  Time now_{};                 // the last tick,
  Vector u_ = Vector::Zero();  // its input
  Vector y_ = Vector::Zero();  // and output
};

}  // namespace limpid
