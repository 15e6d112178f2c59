// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/any_lane.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/flat.hpp>
#include <limpid/core/inverse_factorial.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/small_step_series.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace limpid {

/// Exact step of x'' + beta x' + kappa x = f(t) over h seconds, with f linear in time over the step; each axis
/// for itself.
///
///     r(h): response of x to the unit ramp f = t,   s = r' to the unit step,   g = s' to the unit impulse
///
/// r and s are summed as power series over a piece of h short enough for a fixed number of terms, then doubled
/// until they span h. Nothing is divided by kappa or beta, so that zero and stiff values are alike well conditioned.
/// Where the whole step is short in float or double, as is that of a tool of 0.1 kg in tissue in 1 ms, fewer terms of
/// least largest error do: see `detail::SmallStepSeries`. With other parameters in every step, double, to 1e-15 in 1.03
/// (three axes) and 1.9 times (one) the time of Tustin's rule, which errs by 4e-4; RK4 takes 2.0 and 3.4 times Tustin's
/// and errs by 3e-6, a closed form with libm 7 to 10 times (bench/time_error).
/// @tparam Axes  number of independent axes
/// @realtime     no allocation, no throw; `set` some 40 flops an axis for a short step; else 120 and 15 for each
///               doubling, of which there are at most as many as the scalar's exponent allows (some 1000 in double);
///               `advance` 14
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
    if constexpr (detail::has_small_step_series<Scalar>) {
      const Array B = b * h, K = k * (h * h);
      if (is_small(B, K)) [[likely]] {
        set_small(k, B, K, h);
      } else {
        set_apart(k, b, h);
      }
    } else {
      set_any(k, b, h);
    }
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
    const Array change = f1 - f0;
    // f first: the chain from step to step is then two products long
    const Array x1 = r_per_h_ * change + s_ * f0 + g_ * v + position_decay_ * x;
    v = s_per_h_ * change + g_ * f0 + velocity_decay_ * v + velocity_from_position_ * x;
    x = x1;
  }

  [[nodiscard]] Vector impulse_response() const noexcept { return g_.template head<Axes>(); }  ///< g(h), s
  [[nodiscard]] Vector step_response() const noexcept { return s_.template head<Axes>(); }     ///< s(h), s^2
  /// r(h), s^3: from r/h, as s/(s/h) is h; a member more would slow `set`.
  [[nodiscard]] Vector ramp_response() const noexcept {
    const Array h = (s_per_h_ > Scalar{0}).select(s_ / s_per_h_, Scalar{0});
    return (r_per_h_ * h).template head<Axes>();
  }

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

  struct Responses {
    Array g, s, r;
  };

  // Whether B and K of all axes are within `SmallStepSeries`: a product is negative where its factor is not. What is
  // infinite is not small; a NaN may be taken for it, and stays a NaN.
  static bool is_small(const Array& B, const Array& K) noexcept {
    using Series = detail::SmallStepSeries<Scalar>;
    const Array inside = (B * (Scalar(Series::largest_B) - B)).min(K * (Scalar(Series::largest_K) - K));
    if constexpr (Axes == 1) return inside[0] >= Scalar{0};
    return inside.min(Scalar{0}).sum() >= Scalar{0};
  }

  void set_small(const Array& kappa, const Array& B, const Array& K, const Scalar& h) noexcept {
    constexpr auto& c = detail::SmallStepSeries<Scalar>::coefficients;
    constexpr std::size_t last = c.size() - 1;
    Array r = Array::Constant(Scalar(c[last])), s = Scalar(c[last - 1]) - B * r;
    add_small_terms<last - 1>(B, K, r, s);
    const Array g = (Scalar{1} - K * r) - B * s;
    position_decay_ = Scalar{1} - K * s;
    velocity_decay_ = position_decay_ - B * g;
    g_ = g * h;
    s_per_h_ = s * h;
    s_ = s * (h * h);
    r_per_h_ = r * (h * h);
    velocity_from_position_ = Scalar{0} - kappa * g_;
  }

  // Clenshaw's sum from c_n down, as in `add_terms`.
  template <std::size_t n>
  EIGEN_ALWAYS_INLINE static void add_small_terms(const Array& B, const Array& K, Array& before, Array& sum) noexcept {
    if constexpr (n > 0) {
      const Array next = (Scalar(detail::SmallStepSeries<Scalar>::coefficients[n - 1]) - K * before) - B * sum;
      before = sum;
      sum = next;
      add_small_terms<n - 1>(B, K, before, sum);
    }
  }

  // So that `set` stays small.
  [[gnu::noinline]] void set_apart(const Array& kappa, const Array& beta, const Scalar& h) noexcept {
    flat<Scalar>([&]() noexcept { set_any(kappa, beta, h); });
  }

  void set_any(const Array& kappa, const Array& beta, const Scalar& h) noexcept {
    Scalar piece = h;
    int doublings = 0;
    if (is_too_long(kappa, beta, h)) doublings = halve(kappa, beta, piece);
    Responses of = sum_series(kappa, beta, piece);
    for (; doublings > 0; --doublings) double_length(kappa, beta, piece, of);
    const Scalar rate = h > Scalar{0} ? Scalar{1} / h : Scalar{0};
    position_decay_ = Scalar{1} - kappa * of.s;
    velocity_decay_ = Scalar{1} - beta * of.g - kappa * of.s;
    g_ = of.g;
    s_ = of.s;
    s_per_h_ = of.s * rate;
    r_per_h_ = of.r * rate;
    velocity_from_position_ = Scalar{0} - kappa * g_;
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

  // Shortens the piece until it is no longer than `longest`: how often.
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
  static Responses sum_series(const Array& kappa, const Array& beta, const Scalar& h) noexcept {
    const Array B = beta * h, K = kappa * (h * h);
    Array r = Array::Zero(), s = Array::Constant(detail::inverse_factorial<Scalar, terms() + 2>());
    add_terms<terms() - 2>(B, K, r, s);
    return {(Scalar{1} - K * r - B * s) * h, s * (h * h), r * (h * h * h)};
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
  static void double_length(const Array& kappa, const Array& beta, Scalar& h, Responses& of) noexcept {
    const auto [g, s, r] = of;
    const Array from_position = Scalar{1} - kappa * s, from_velocity = Scalar{1} - beta * g - kappa * s;
    of.r = r + from_position * r + g * s + h * s;
    of.s = s + from_position * s + g * g;
    of.g = g * (from_position + from_velocity);
    h *= 2;
  }

  Array g_ = Array::Zero(), s_ = Array::Zero(), s_per_h_ = Array::Zero(), r_per_h_ = Array::Zero();
  Array position_decay_ = Array::Ones(), velocity_decay_ = Array::Ones(), velocity_from_position_ = Array::Zero();
};

}  // namespace limpid
