// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/delay_characteristic.hpp>
#include <limpid/design/design_point.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

namespace limpid {

/// The prediction error with a constant delay and no sampling, (4.16) with e_d(t) = e(t - delay):
///
///     m s^2 + (b_t + b_e) s + (k_t + k_e) = (L1 + L2 s) exp(-s delay)
template <Real Scalar = double>
struct DelaySystem {
  Tool<1, Scalar> tool{};
  Scalar delay{0};  ///< s, >= 0

  /// @throws std::invalid_argument  where a field cannot be used
  void check() const {
    tool.check();
    expect(is_finite(delay) && delay >= Scalar{0}, "DelaySystem: delay", "finite and >= 0", delay);
  }
};

namespace detail {

template <Real Scalar>
[[nodiscard]] DelayCharacteristic<Scalar> characteristic_of(const DelaySystem<Scalar>& system,
                                                            const Tissue<Scalar>& tissue, const Gain<Scalar>& L) {
  system.check();
  expect(is_finite(tissue.stiffness), "Tissue: stiffness", "finite", tissue.stiffness);
  expect(is_finite(tissue.damping), "Tissue: damping", "finite", tissue.damping);
  expect(is_finite(L), "Gain", "finite", L);
  const Scalar m = system.tool.mass;
  return {(system.tool.stiffness + tissue.stiffness) / m, (system.tool.damping + tissue.damping) / m, L[0] / m,
          L[1] / m, system.delay};
}

/// Rightmost root of a characteristic equation, between an abscissa with and one without a root to its right.
template <Real Scalar>
class RightmostRoot {
 public:
  using Complex = std::complex<Scalar>;

  explicit RightmostRoot(const DelayCharacteristic<Scalar>& f) : f_{f} {}

  [[nodiscard]] Complex find() {
    using std::abs, std::sqrt;
    if (f_.delay == Scalar{0}) return f_.rightmost_without_delay();
    if (!bracket()) return none();
    // Newton's method once the bracket is narrow; what it finds counts only if nothing is to the right of it.
    for (const int digits : {12, 24, std::numeric_limits<Scalar>::digits}) {
      narrow(digits);
      for (const Scalar& omega : starts()) {
        const Complex root = polish(Complex(upper_, omega));
        if (is_rightmost(root)) return root;
      }
    }
    // A multiple root, as far as it can be told.
    Complex best(upper_, Scalar{0});
    for (const Scalar& omega : starts()) {
      if (std::abs(f_.value(Complex(upper_, omega))) < std::abs(f_.value(best))) best = Complex(upper_, omega);
    }
    return best;
  }

 private:
  static Complex none() { return {std::numeric_limits<Scalar>::infinity(), Scalar{0}}; }

  [[nodiscard]] bool bracket() {
    using std::abs, std::sqrt;
    // Where Re s >= 0: |s|^2 <= (|beta| + |l2|) |s| + |kappa| + |l1|.
    const Scalar b = abs(f_.beta) + abs(f_.l2), c = abs(f_.kappa) + abs(f_.l1);
    scale_ = b + sqrt(c) + Scalar{1} / f_.delay;
    if (!is_finite(scale_)) return false;
    upper_ = Scalar{0};
    const int right = f_.roots_right_of(Scalar{0});
    if (right > 0) {
      lower_ = Scalar{0};
      upper_ = b + sqrt(c);
      return true;
    }
    if (right < 0) return false;
    Scalar step = std::min<Scalar>(scale_, Scalar{1} / f_.delay);
    for (int doublings = 0; doublings < 64; ++doublings, step *= Scalar{2}) {
      lower_ = upper_ - step;
      const int count = f_.roots_right_of(lower_);
      if (count > 0) return true;
      if (count < 0) {
        step /= Scalar{4};  // too far to count
      } else {
        upper_ = lower_;
      }
    }
    return false;
  }

  void narrow(int digits) {
    using std::abs, std::ldexp;
    const Scalar width = ldexp(scale_, -digits);
    while (upper_ - lower_ > width) {
      const Scalar middle = lower_ + (upper_ - lower_) / Scalar{2};
      if (!(lower_ < middle && middle < upper_)) return;
      (f_.roots_right_of(middle) > 0 ? lower_ : upper_) = middle;
    }
  }

  // Where the edge of the half plane is crossed, and where the two crossings come together.
  [[nodiscard]] std::array<Scalar, 4> starts() const {
    using std::sqrt;
    const auto f = f_.shifted(upper_);
    const auto [larger, smaller, zero] = f.crossing_frequencies();
    const Scalar middle = f.kappa - (f.beta * f.beta - f.l2 * f.l2) / Scalar{2};
    return {larger, smaller, middle > Scalar{0} ? sqrt(middle) : Scalar{0}, zero};
  }

  // A root; not finite where the steps do not end.
  [[nodiscard]] Complex polish(Complex s) const {
    using std::abs;
    constexpr int most_steps = 20;
    for (int i = 0; i < most_steps; ++i) {
      const Complex step = f_.value(s) / f_.derivative(s);
      if (!is_finite(step.real()) || !is_finite(step.imag())) return none();
      s -= step;
      const Scalar size = abs(step.real()) + abs(step.imag());
      if (size <= Scalar{4} * std::numeric_limits<Scalar>::epsilon() * (abs(s.real()) + abs(s.imag()))) {
        return {s.real(), abs(s.imag())};
      }
    }
    return none();
  }

  // To within what is far below the distance of simple roots, and above the rounding of the count.
  [[nodiscard]] bool is_rightmost(const Complex& root) const {
    using std::sqrt;
    if (!is_finite(root.real())) return false;
    const Scalar margin = scale_ * sqrt(std::numeric_limits<Scalar>::epsilon()) / Scalar{64};
    if (root.real() < lower_ - margin || root.real() > upper_ + margin) return false;
    return f_.roots_right_of(root.real() + margin) == 0 && f_.roots_right_of(root.real() - margin) > 0;
  }

  DelayCharacteristic<Scalar> f_;
  Scalar lower_{0}, upper_{0}, scale_{0};
};

}  // namespace detail

/// How many roots, counted with their multiplicity, lie to the right of `abscissa`; which is exact but for rounding
/// where a root comes to it. -1 where that is not known: where the numbers or the count are too large to tell.
///
/// Roots enter and leave the half plane only where a delay grown from zero puts a pair on its edge, at frequencies that
/// a quadratic in omega^2 gives.
/// Off line: 0.1 us.
/// @throws std::invalid_argument  where an argument is not finite or the system refused
template <Real Scalar>
[[nodiscard]] int delay_roots_right_of(const DelaySystem<Scalar>& system, const Tissue<Scalar>& tissue,
                                       const Gain<Scalar>& L, const Scalar& abscissa) {
  expect(is_finite(abscissa), "delay_roots_right_of: abscissa", "finite", abscissa);
  const auto f = detail::characteristic_of(system, tissue, L);
  const Scalar unit = f.time_unit();
  return f.in_units_of(unit).roots_right_of(abscissa * unit);
}

/// Whether every root has a negative real part; no where one is on the axis to within rounding, or the numbers are too
/// large to tell.
template <Real Scalar>
[[nodiscard]] bool delay_stable(const DelaySystem<Scalar>& system, const Tissue<Scalar>& tissue,
                                const Gain<Scalar>& L) {
  const auto given = detail::characteristic_of(system, tissue, L);
  const auto f = given.in_units_of(given.time_unit());
  return f.roots_right_of(Scalar{0}) == 0 && !f.has_root_on_axis();
}

/// The rightmost root, of a pair the one above the real axis, 1/s: bracketed by the number of roots to the right of an
/// abscissa, polished on the characteristic equation, and counted again. To rounding where it is simple, to the square
/// root of it where it is double. Infinite where the numbers are too large to tell.
///
/// Off line: some 5 us.
/// @throws std::invalid_argument  where an argument is not finite or the system refused
template <Real Scalar>
[[nodiscard]] std::complex<Scalar> rightmost_delay_root(const DelaySystem<Scalar>& system, const Tissue<Scalar>& tissue,
                                                        const Gain<Scalar>& L) {
  const auto f = detail::characteristic_of(system, tissue, L);
  const Scalar unit = f.time_unit();
  return detail::RightmostRoot<Scalar>(f.in_units_of(unit)).find() / unit;
}

/// The smallest delay with which the error is not stable, s: zero where it is not even without delay, or the numbers
/// are too large or too different to tell, infinite where no delay makes it so.
/// @throws std::invalid_argument  where an argument is not finite or the tool refused
template <Real Scalar>
[[nodiscard]] Scalar delay_margin(const Tool<1, Scalar>& tool, const Tissue<Scalar>& tissue, const Gain<Scalar>& L) {
  const auto f = detail::characteristic_of(DelaySystem<Scalar>{tool, Scalar{0}}, tissue, L);
  const Scalar unit = f.time_unit();
  return f.in_units_of(unit).margin() * unit;
}

}  // namespace limpid
