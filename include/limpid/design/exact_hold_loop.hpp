// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/design/bracketed_root.hpp>
#include <limpid/design/gain_peak.hpp>
#include <limpid/design/hinf_norm.hpp>
#include <limpid/design/transparency_problem.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace limpid::detail {

/// The loop with the exact hold, model C, along the imaginary axis. q = s (m s + b) + ZOH (B_c s + K_c) and
/// N = s (alpha m s + beta b) have no poles, and with |ZOH| <= min(1, 2/(w T)) and |dZOH/dw| <= min(T/2, 2/w) their
/// slopes are bounded:
///
///     |q'| <= 2 m w + b + |B_c| |ZOH| + (|K_c| + |B_c| w) |dZOH/dw|,     |N'| <= 2 alpha m w + beta b
///
/// so that a value speaks for a cell about it, and a finite number of cells for the axis.
template <Real Scalar>
class ExactHoldLoop {
 public:
  using Complex = std::complex<Scalar>;

  ExactHoldLoop(const TransparencyProblem<Scalar>& problem, const WallFeedback<Scalar>& C)
      : problem_{problem}, C_{C}, m_{problem.plant.mass}, b_{problem.plant.damping}, T_{problem.period} {}

  /// Whether q has no zero in the closed right half plane, by the argument of q along the axis, in steps over which it
  /// cannot turn by more than 30 degrees; no where q comes to zero on the axis to within rounding, or 400 000 steps
  /// do not tell.
  ///
  /// For Re s >= 0 it is |ZOH| <= 1, so beyond the end q winds as m s^2.
  [[nodiscard]] bool is_stable() const {
    using std::abs, std::atan2, std::floor, std::sqrt;
    const Scalar first = b_ + abs(C_.B_c), end = (first + sqrt(first * first + Scalar{2} * m_ * abs(C_.K_c))) / m_;
    const Scalar least = Scalar(16) * std::numeric_limits<Scalar>::epsilon();
    if (!is_finite(end)) return false;
    Scalar omega{0}, step = end / Scalar(64), turned{0};
    Complex q = characteristic(problem_, C_, omega);
    for (int steps = 0; omega < end; ++steps) {
      const Scalar size = size_of(q);
      step = std::min<Scalar>(Scalar{2} * step, end - omega);
      while (slope_bound(omega, omega + step) * step > size / Scalar{2}) {
        step /= Scalar{2};
        if (!(step > least * omega)) return false;
      }
      if (steps == most_cells) return false;
      omega = end - omega > step ? Scalar(omega + step) : end;
      const Complex next = characteristic(problem_, C_, omega), turn = over(next, q);
      turned += atan2(turn.imag(), turn.real());
      q = next;
    }
    const Scalar left = atan2(-q.imag(), -q.real());  // from the argument of -m w^2
    const Scalar zeros = Scalar{1} - (turned - left) / (Scalar{4} * atan2(Scalar{1}, Scalar{1}));
    return abs(zeros) < Scalar{1} / Scalar{2};
  }

  /// ||L||_inf of a stable loop without proof: the highest value of a sweep, polished.
  [[nodiscard]] GainPeak<Scalar> peak() const {
    using std::acos, std::sqrt;
    const Scalar nyquist = acos(Scalar{-1}) / T_;
    GainPeak<Scalar> best{limit(), infinity_of<Scalar>()};
    Scalar before{0}, omega = std::min<Scalar>(nyquist, sqrt(problem_.wall.stiffness / m_)) / Scalar(256);
    omega = std::max<Scalar>(omega, std::numeric_limits<Scalar>::min());
    while (omega < Scalar(16) * nyquist) {
      const Scalar step = std::min<Scalar>(omega / Scalar(16), nyquist / Scalar(32)), after = omega + step;
      if (gain(omega) > best.value) best = polished(before, omega, after, best);
      before = omega;
      omega = after;
    }
    return best;
  }

  /// ||L||_inf of a stable loop: the peak, and a level above it that cells over the whole axis prove not to be passed.
  [[nodiscard]] HinfNorm<Scalar> norm() const {
    using std::ldexp;
    GainPeak<Scalar> best = peak();
    if (best.value == Scalar{0}) return {best.value, best.frequency, best.value, best.value, NormVerdict::finite};
    Scalar gap = ldexp(Scalar{1}, -std::min(28, std::numeric_limits<Scalar>::digits / 2));
    while (gap < Scalar(1000)) {
      const Scalar level = best.value * (Scalar{1} + gap);
      const Check check = confirm(level);
      if (check.below) return {best.value, best.frequency, best.value, level, NormVerdict::finite};
      if (check.above > Scalar{0} && gain(check.above) > best.value) {
        best = polished(check.above * Scalar(0.99), check.above, check.above * Scalar(1.01), best);
      } else {
        gap *= Scalar{8};
      }
    }
    const Scalar infinity = infinity_of<Scalar>();
    return {infinity, best.frequency, best.value, infinity, NormVerdict::undecided};
  }

 private:
  static constexpr int most_cells = 400'000;

  struct Check {
    bool below = false;
    Scalar above{0};  ///< a frequency at which the level is passed, if there is one
  };

  static Scalar size_of(const Complex& z) {
    using std::sqrt;
    return sqrt(z.real() * z.real() + z.imag() * z.imag());
  }
  static Complex over(const Complex& a, const Complex& b) {
    const Scalar square = b.real() * b.real() + b.imag() * b.imag();
    return {(a.real() * b.real() + a.imag() * b.imag()) / square, (a.imag() * b.real() - a.real() * b.imag()) / square};
  }

  [[nodiscard]] Scalar limit() const { return problem_.uncertainty.alpha; }
  [[nodiscard]] Complex numerator(const Scalar& omega) const {
    const auto& [alpha, beta] = problem_.uncertainty;
    return {-alpha * m_ * omega * omega, beta * b_ * omega};
  }
  [[nodiscard]] Scalar gain(const Scalar& omega) const {
    return size_of(numerator(omega)) / size_of(characteristic(problem_, C_, omega));
  }
  /// Of |q'| from one frequency to another.
  [[nodiscard]] Scalar slope_bound(const Scalar& from, const Scalar& to) const {
    using std::abs;
    const Scalar B = abs(C_.B_c), K = abs(C_.K_c), half = from * T_ / Scalar{2};
    const Scalar hold = half > Scalar{1} ? Scalar(Scalar{1} / half) : Scalar{1};
    const Scalar turn = half > Scalar{2} ? Scalar(Scalar{2} / from) : Scalar(T_ / Scalar{2});
    return Scalar{2} * m_ * to + b_ + B * hold + (K + B * to) * turn;
  }

  /// The logarithmic slope of |L|, Re(N'/N - q'/q).
  [[nodiscard]] Scalar slope(const Scalar& omega) const {
    using std::cos, std::sin;
    const auto& [alpha, beta] = problem_.uncertainty;
    const Complex Z = exact_hold(omega, T_), control(C_.K_c, C_.B_c * omega);
    // dZ/dw = (exp(-i w T) - Z)/w
    const Complex dZ((cos(omega * T_) - Z.real()) / omega, (-sin(omega * T_) - Z.imag()) / omega);
    const Complex dq = Complex(Scalar{-2} * m_ * omega, b_) + dZ * control + Z * Complex(Scalar{0}, C_.B_c);
    const Complex dN(Scalar{-2} * alpha * m_ * omega, beta * b_);
    return over(dN, numerator(omega)).real() - over(dq, characteristic(problem_, C_, omega)).real();
  }

  [[nodiscard]] GainPeak<Scalar> polished(const Scalar& before, const Scalar& omega, const Scalar& after,
                                          const GainPeak<Scalar>& best) const {
    GainPeak<Scalar> found{gain(omega), omega};
    const Scalar a = std::max<Scalar>(before, omega / Scalar{2}), rising = slope(a), falling = slope(after);
    if (rising > Scalar{0} && falling < Scalar{0}) {
      const Scalar top =
          bracketed_root([&](const Scalar& at) -> Scalar { return slope(at); }, a, rising, after, falling);
      if (gain(top) >= found.value) found = {gain(top), top};
    }
    return found.value > best.value ? found : best;
  }

  /// Beyond `omega`: |N| <= |s (m s + b)| min(max(alpha, beta), alpha + beta b/(m w)), |ZOH| <= 2/(w T).
  [[nodiscard]] bool is_tail_below(const Scalar& level, const Scalar& omega) const {
    using std::abs;
    const Scalar hold = std::min<Scalar>(Scalar{1}, Scalar{2} / (omega * T_));
    const Scalar part = hold * (abs(C_.K_c) / omega + abs(C_.B_c)) / (m_ * omega);
    const auto& [alpha, beta] = problem_.uncertainty;
    const Scalar size = std::min<Scalar>(std::max(alpha, beta), alpha + beta * problem_.plant.damping / (m_ * omega));
    return size < level * (Scalar{1} - part) * (Scalar{1} - rounding());
  }

  static Scalar rounding() { return Scalar(256) * std::numeric_limits<Scalar>::epsilon(); }

  /// Whether |L| < level on the whole axis.
  [[nodiscard]] Check confirm(const Scalar& level) const {
    using std::acos;
    Scalar end = acos(Scalar{-1}) / T_;
    for (int doublings = 0; !is_tail_below(level, end); ++doublings) {
      if (doublings > 40) return {};
      end *= Scalar{2};
    }
    const auto& [alpha, beta] = problem_.uncertainty;
    Scalar omega{0}, width = end / Scalar(1024);
    for (int cells = 0; cells < most_cells; ++cells) {
      if (!(omega < end)) return {true, Scalar{0}};
      width = std::min<Scalar>(Scalar{2} * width, end - omega);
      for (;; width /= Scalar{2}) {
        const Scalar radius = width / Scalar{2}, centre = omega + radius, edge = omega + width;
        const Scalar N = size_of(numerator(centre)), q = size_of(characteristic(problem_, C_, centre));
        if (N >= level * q) return {false, centre};
        const Scalar most = N + radius * (Scalar{2} * alpha * m_ * edge + beta * b_);
        if (most < level * (q - radius * slope_bound(omega, edge)) * (Scalar{1} - rounding())) break;
        if (!(width > rounding() * end / Scalar(1024))) return {};
      }
      omega = end - omega > width ? Scalar(omega + width) : end;
    }
    return {};
  }

  TransparencyProblem<Scalar> problem_;
  WallFeedback<Scalar> C_;
  Scalar m_, b_, T_;
};

}  // namespace limpid::detail
