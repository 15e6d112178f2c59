// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/any_lane.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/inverse_factorial.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <limits>

namespace limpid {

/// Exact step of x'' + beta x' + kappa x = f(t) over h seconds, with f linear in time over the step; each axis
/// for itself.
///
///     r(h): response of x to the unit ramp f = t,   s = r' to the unit step,   g = s' to the unit impulse
///
/// r and s are summed as power series over a piece of h short enough for a fixed number of terms, then doubled
/// until they span h. Nothing is divided by kappa or beta, so that zero and stiff values are alike well conditioned.
/// With other parameters in every step to 1e-15 in 1.5 times the time of Tustin's rule, which errs by 4e-4; RK4 takes
/// twice Tustin's and errs by 3e-6, a closed form with libm ten times as long as the series (bench/time_error, three
/// axes).
/// @tparam Axes  number of independent axes
/// @realtime     no allocation, no throw; `set` some 120 flops an axis and 15 for each doubling, of which there are at
///               most as many as the scalar's exponent allows (some 1000 in double); `advance` 14
template <int Axes = 1, Real Scalar = double>
class SecondOrderStep {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Array = Lanes<Axes, Scalar>;

  /// @param kappa  stiffness over mass, 1/s^2
  /// @param beta   damping over mass, 1/s
  /// @param h      length of the step, s, not negative
  /// Where beta h or sqrt(kappa) h is not finite there is no step: `advance` then gives NaN.
  void set(const Vector& kappa, const Vector& beta, const Scalar& h) noexcept {
    set_lanes(to_lanes<Axes>(kappa), to_lanes<Axes>(beta), h);
  }
  void set_lanes(const Array& k, const Array& b, const Scalar& h) noexcept {
    Scalar piece = h;
    int doublings = 0;
    if (is_too_long(k, b, h)) [[unlikely]]
      doublings = halve(k, b, piece);
    sum_series(k, b, piece);
    for (; doublings > 0; --doublings) double_length(k, b, piece);
    position_decay_ = Scalar{1} - k * s_;
    velocity_decay_ = Scalar{1} - b * g_ - k * s_;
    velocity_from_position_ = -k * g_;
    rate_ = h > Scalar{0} ? Scalar{1} / h : Scalar{0};
  }

  /// Takes (x, v) from the start of the step to its end.
  /// @param f0, f1  force over mass at the start and at the end, m/s^2
  void advance(Vector& x, Vector& v, const Vector& f0, const Vector& f1) const noexcept {
    Array x_lanes = to_lanes<Axes>(x), v_lanes = to_lanes<Axes>(v);
    advance_lanes(x_lanes, v_lanes, to_lanes<Axes>(f0), to_lanes<Axes>(f1));
    x = from_lanes<Axes>(x_lanes);
    v = from_lanes<Axes>(v_lanes);
  }
  void advance_lanes(Array& x, Array& v, const Array& f0, const Array& f1) const noexcept {
    const Array slope = (f1 - f0) * rate_;
    // f first: the chain from step to step is then two products long
    const Array x1 = r_ * slope + s_ * f0 + position_decay_ * x + g_ * v;
    v = s_ * slope + g_ * f0 + velocity_from_position_ * x + velocity_decay_ * v;
    x = x1;
  }

  [[nodiscard]] Vector impulse_response() const noexcept { return g_.template head<Axes>(); }  ///< g(h), s
  [[nodiscard]] Vector step_response() const noexcept { return s_.template head<Axes>(); }     ///< s(h), s^2
  [[nodiscard]] Vector ramp_response() const noexcept { return r_.template head<Axes>(); }     ///< r(h), s^3

 private:
  static constexpr double longest = 0.5;  // of |beta| h and sqrt(|kappa|) h within one series

  // From the scalar's largest number to `longest`; of scalars with wider exponents than any built-in one, fewer.
  static constexpr int most_doublings =
      std::min(static_cast<int>(std::numeric_limits<Scalar>::max_exponent), 16'384) + 2;

  // u_n of `sum_series` is at most (golden ratio * longest)^n; the first term left out is below a rounding.
  static constexpr int terms() {
    double bound = 1, precision = 1;
    for (int bit = 0; bit < std::numeric_limits<Scalar>::digits + 2; ++bit) precision /= 2;
    int n = 0;
    for (; (n + 3) * bound > precision; ++n) bound *= 1.6181 * longest / (n + 4);
    return n;
  }

  // By 2 |kappa| h^2, which is `longest` where sqrt(|kappa|) h is; what is not finite is too long.
  static bool is_too_long(const Array& kappa, const Array& beta, const Scalar& h) noexcept {
    static_assert(longest == 0.5);
    if constexpr (detail::in_packets<Array>) {
      return !detail::all_at_most(Array(beta.abs() * h), Scalar(longest)) ||
             !detail::all_at_most(Array(kappa.abs() * (Scalar{2} * h * h)), Scalar(longest));
    }
    const Array sizes = (beta.abs() * h).max(kappa.abs() * (Scalar{2} * h * h));
    return !(((sizes - Scalar(longest)).max(Scalar{0}) + (beta + kappa) * (h * Scalar{0})).sum() <= Scalar{0});
  }

  // Shortens the piece until it is no longer than `longest`: how often. Apart, so that `set` stays small.
  [[gnu::noinline]] static int halve(const Array& kappa, const Array& beta, Scalar& piece) noexcept {
    const Scalar none = std::numeric_limits<Scalar>::quiet_NaN();
    const Array sizes = (beta.abs() * piece).max(kappa.abs().sqrt() * piece);
    Scalar size = is_finite(sizes) ? sizes.maxCoeff() : none;
    int count = 0;
    for (; size > longest && count < most_doublings; size /= 2, piece /= 2) ++count;
    if (!(size <= Scalar(longest))) piece = none;
    return count;
  }

  // r/h^3 = sum u_n/(n + 3)! and s/h^2 = sum u_n/(n + 2)! with u_(n+1) = -B u_n - K u_(n-1), u_0 = 1, backwards
  // (Clenshaw): b_n = 1/(n + 3)! - B b_(n+1) - K b_(n+2) ends in r/h^3 at n = 0, s/h^2 at -1 and g/h at -2.
  void sum_series(const Array& kappa, const Array& beta, const Scalar& h) noexcept {
    const Array B = beta * h, K = kappa * (h * h);
    Array r = Array::Zero(), s = Array::Constant(detail::inverse_factorial<Scalar, terms() + 2>());
    add_terms<terms() - 2>(B, K, r, s);
    g_ = (Scalar{1} - K * r - B * s) * h;
    s_ = s * (h * h);
    r_ = r * (h * h * h);
  }

  // Takes (b_(n+2), b_(n+1)) to (b_0, b_(-1)). Unrolled, so that the factorials are constants of the program.
  template <int n>
  EIGEN_ALWAYS_INLINE static void add_terms(const Array& B, const Array& K, Array& before, Array& sum) noexcept {
    const Array next = (detail::inverse_factorial<Scalar, n + 3>() - K * before) - B * sum;
    before = sum;
    sum = next;
    if constexpr (n > -1) add_terms<n - 1>(B, K, before, sum);
  }

  // The second half starts from where the first one ended; its ramp starts at h.
  void double_length(const Array& kappa, const Array& beta, Scalar& h) noexcept {
    const Array from_position = Scalar{1} - kappa * s_;
    const Array from_velocity = Scalar{1} - beta * g_ - kappa * s_;
    const Array r = r_ + from_position * r_ + g_ * s_ + h * s_;
    const Array s = s_ + from_position * s_ + g_ * g_;
    g_ = g_ * (from_position + from_velocity);
    s_ = s;
    r_ = r;
    h *= 2;
  }

  Array g_ = Array::Zero(), s_ = Array::Zero(), r_ = Array::Zero();
  Array position_decay_ = Array::Ones(), velocity_decay_ = Array::Ones(), velocity_from_position_ = Array::Zero();
  Scalar rate_{0};  // 1/h
};

}  // namespace limpid
