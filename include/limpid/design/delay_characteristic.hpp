// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

namespace limpid::detail {

/// f(s) = s^2 + beta s + kappa - (l1 + l2 s) exp(-s delay)
template <Real Scalar>
struct DelayCharacteristic {
  using Complex = std::complex<Scalar>;

  Scalar kappa, beta, l1, l2, delay;

  [[nodiscard]] Complex value(const Complex& s) const { return (s + beta) * s + kappa - (l1 + l2 * s) * lag(s); }
  [[nodiscard]] Complex derivative(const Complex& s) const {
    return Scalar{2} * s + beta - (l2 - delay * (l1 + l2 * s)) * lag(s);
  }

  /// Of the time t/unit, s unit in place of s.
  [[nodiscard]] DelayCharacteristic in_units_of(const Scalar& unit) const {
    return {times(times(kappa, unit), unit), times(beta, unit), times(times(l1, unit), unit), times(l2, unit),
            delay / unit};
  }

  /// A power of two, so that nothing is rounded, in which the largest coefficient is about one.
  [[nodiscard]] Scalar time_unit() const {
    using std::abs, std::ldexp, std::logb, std::max, std::sqrt;
    const Scalar fastest = max<Scalar>(max<Scalar>(abs(beta), abs(l2)), sqrt(max<Scalar>(abs(kappa), abs(l1))));
    if (!(fastest > Scalar{0}) || !is_finite(fastest)) return Scalar{1};
    return ldexp(Scalar{1}, std::min(-static_cast<int>(logb(fastest)), std::numeric_limits<Scalar>::max_exponent - 2));
  }

  /// f(s + abscissa), which has the same form.
  [[nodiscard]] DelayCharacteristic shifted(const Scalar& abscissa) const {
    using std::exp;
    const Scalar growth = exp(-abscissa * delay);
    return {kappa + abscissa * (beta + abscissa), beta + Scalar{2} * abscissa, (l1 + l2 * abscissa) * growth,
            l2 * growth, delay};
  }

  /// Frequencies omega at which |kappa - omega^2 + i beta omega| = |l1 + i l2 omega|, where some delay has the root
  /// i omega: the larger one, at which a pair moves to the right as the delay grows, the smaller one, at which it moves
  /// to the left, zero in place of what there is not, and zero.
  [[nodiscard]] std::array<Scalar, 3> crossing_frequencies() const {
    using std::sqrt;
    const Scalar p = half_sum(), d = discriminant();
    if (!(d > Scalar{0})) return {};
    const Scalar far = p > Scalar{0} ? -p - sqrt(d) : sqrt(d) - p;
    const Scalar near = far == Scalar{0} ? far : product() / far;
    const auto root = [](const Scalar& Omega) { return Omega > Scalar{0} ? sqrt(Omega) : Scalar{0}; };
    return far > near ? std::array<Scalar, 3>{root(far), root(near), Scalar{0}}
                      : std::array<Scalar, 3>{root(near), root(far), Scalar{0}};
  }

  /// The angle omega h in [0, 2 pi) that puts i omega on the characteristic with the delay h.
  [[nodiscard]] Scalar crossing_angle(const Scalar& omega) const {
    using std::atan2;
    Scalar stiff = kappa - omega * omega;
    if (beta == l2) {
      // Then it is l1 or -l1; with l1 the angle is zero, which rounding must not turn to a little below 2 pi.
      if (stiff * l1 >= Scalar{0}) return Scalar{0};
      stiff = -l1;
    }
    const Scalar angle = atan2(omega * (l2 * stiff - l1 * beta), l1 * stiff + l2 * beta * omega * omega);
    return angle < Scalar{0} ? angle + two_pi() : angle;
  }

  /// Roots with a real part above `abscissa`; -1 where that is not known.
  [[nodiscard]] int roots_right_of(const Scalar& abscissa) const {
    using std::ceil, std::floor;
    const DelayCharacteristic f = shifted(abscissa);
    const Scalar squares = f.kappa * f.kappa + f.beta * f.beta + f.l1 * f.l1 + f.l2 * f.l2;
    if (!is_finite(squares) || !is_finite(f.discriminant())) return -1;
    const auto [larger, smaller, zero] = f.crossing_frequencies();
    const Scalar right = larger > zero ? f.turns(larger) : Scalar{-1};
    const Scalar left = smaller > zero ? f.turns(smaller) : Scalar{-1};
    if (!(right < most_turns()) || !(left < most_turns())) return -1;
    // A pair that is on the edge with the delay itself is not to the right of it.
    const int entered = right > Scalar{0} ? static_cast<int>(ceil(right)) : 0;
    const int departed = left < Scalar{0} ? 0 : static_cast<int>(floor(left)) + 1;
    if (f.kappa == f.l1 && f.is_triple_passed()) return -1;
    const int count =
        f.right_without_delay() + 2 * (entered - departed) + (f.kappa == f.l1 ? f.entered_through_zero() : 0);
    return count < 0 ? -1 : count;  // below zero: a root within rounding of the edge
  }

  /// Whether a root lies on the imaginary axis, to within the rounding of the delays that put one there.
  [[nodiscard]] bool has_root_on_axis() const {
    using std::abs, std::floor;
    if (kappa == l1) return true;
    if (delay == Scalar{0} || (l1 == Scalar{0} && l2 == Scalar{0})) return beta == l2 && kappa > l1;
    const auto [larger, smaller, zero] = crossing_frequencies();
    for (const Scalar& omega : {larger, smaller, touching_frequency()}) {
      if (!(omega > zero)) continue;
      const Scalar n = turns(omega), nearest = floor(n + Scalar{1} / Scalar{2});
      if (abs(n - nearest) <= Scalar{16} * std::numeric_limits<Scalar>::epsilon() * (Scalar{1} + abs(n))) return true;
    }
    return false;
  }

  /// The smallest delay with a root on or right of the imaginary axis; zero where that is not known.
  [[nodiscard]] Scalar margin() const {
    const Scalar none = std::numeric_limits<Scalar>::infinity();
    if (!is_finite(discriminant())) return Scalar{0};
    if (right_without_delay() > 0 || !(beta > l2) || !(kappa > l1)) return Scalar{0};
    const Scalar omega = std::max<Scalar>(crossing_frequencies()[0], touching_frequency());
    return omega > Scalar{0} ? crossing_angle(omega) / omega : none;
  }

  [[nodiscard]] Complex rightmost_without_delay() const {
    using std::sqrt;
    const Scalar half = (beta - l2) / Scalar{2}, product = kappa - l1, discriminant = half * half - product;
    if (discriminant < Scalar{0}) return {-half, sqrt(-discriminant)};
    const Scalar root = sqrt(discriminant);
    return {half > Scalar{0} ? -product / (half + root) : root - half, Scalar{0}};
  }

 private:
  // Omega^2 + 2 p Omega + q = 0, Omega = omega^2: p, q and p^2 - q
  [[nodiscard]] Scalar half_sum() const { return (beta - l2) * (beta + l2) / Scalar{2} - kappa; }
  [[nodiscard]] Scalar product() const { return times(kappa - l1, kappa + l1); }
  [[nodiscard]] Scalar discriminant() const {
    return beta == l2 ? times(l1, l1) : times(half_sum(), half_sum()) - product();
  }

  // NaN where digits of it are lost to underflow: nothing is known then.
  [[nodiscard]] static Scalar times(const Scalar& x, const Scalar& y) {
    using std::abs;
    using Limits = std::numeric_limits<Scalar>;
    const Scalar result = x * y;
    return x == Scalar{0} || y == Scalar{0} || abs(result) >= Limits::min() ? result : Limits::quiet_NaN();
  }

  // Where the two frequencies are one: a pair comes to the axis and goes back; zero where there is none.
  [[nodiscard]] Scalar touching_frequency() const {
    using std::sqrt;
    return discriminant() == Scalar{0} && half_sum() < Scalar{0} ? sqrt(-half_sum()) : Scalar{0};
  }

  // From the first delay that puts i omega on the characteristic, in periods of it.
  [[nodiscard]] Scalar turns(const Scalar& omega) const { return (omega * delay - crossing_angle(omega)) / two_pi(); }

  // Up to here the rounding of the turns is far below one, and twice their number is an int.
  static Scalar most_turns() {
    using std::ldexp;
    return ldexp(Scalar{1}, std::min(29, std::numeric_limits<Scalar>::digits - 8));
  }

  // s^2 + (beta - l2) s + kappa - l1; of a pair on the axis, whether the least delay moves it to the right and no
  // crossing counts that, or to the left and a crossing does.
  [[nodiscard]] int right_without_delay() const {
    if (kappa < l1) return 1;
    if (kappa == l1) return beta < l2 ? 1 : 0;
    if (beta < l2) return 2;
    if (beta > l2 || l1 < Scalar{0}) return 0;
    // beta = l2: at omega^2 = kappa - l1, the smaller frequency with l1 > 0. With l1 = 0 the axis is touched only, and
    // s^2 + beta s (1 - exp(-s delay)) + kappa is damped as beta is.
    return l1 > Scalar{0} || (beta < Scalar{0} && delay > Scalar{0}) ? 2 : 0;
  }

  // kappa = l1: f(0) = 0 and f'(0) = beta - l2 + l1 delay, so with delay = (l2 - beta)/l1 a second, real root passes
  // zero. There f''(0)/2 = -p/l1: it moves to the left where p < 0, to the right where p > 0.
  [[nodiscard]] int entered_through_zero() const {
    const Scalar before = beta - l2, after = before + l1 * delay, p = half_sum();
    if (p < Scalar{0}) {
      return (before < Scalar{0} && after >= Scalar{0}) || (before > Scalar{0} && after <= Scalar{0}) ? -1 : 0;
    }
    return (before < Scalar{0} && after > Scalar{0}) || (before >= Scalar{0} && after < Scalar{0}) ? 1 : 0;
  }

  // p = 0: three roots meet at zero, with kappa = l1 = 0 and beta = l2 with the delay -1/l2.
  [[nodiscard]] bool is_triple_passed() const {
    if (half_sum() != Scalar{0}) return false;
    const Scalar before = beta - l2, after = before + l1 * delay;
    if (before == Scalar{0}) return -l2 * delay >= Scalar{1};
    return before < Scalar{0} ? after >= Scalar{0} : after <= Scalar{0};
  }

  [[nodiscard]] Complex lag(const Complex& s) const {
    using std::cos, std::exp, std::sin;
    const Scalar size = exp(-s.real() * delay), angle = s.imag() * delay;
    return {size * cos(angle), -size * sin(angle)};
  }

  static Scalar two_pi() {
    using std::acos;
    static const Scalar value = Scalar{2} * acos(Scalar{-1});
    return value;
  }
};

}  // namespace limpid::detail
