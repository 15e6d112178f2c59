// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace limpid {

/// What a curve takes of the four coefficients from `first` on: its value and its slope are their weighted sums.
template <Real Scalar = double>
struct SplineWeights {
  int first = 0;
  std::array<Scalar, 4> value{};
  std::array<Scalar, 4> slope{};  ///< 1/m
};

/// Uniform cubic B-spline over a range of coefficients that grows: coefficient j belongs to the knot at j spacing.
/// Beyond the outermost knots with full support the curve goes on straight, along its tangent there.
/// @realtime  no allocation, no throw for built-in scalars; `at` some 40 flops
template <Real Scalar = double>
class SplineKnots {
 public:
  /// Four coefficients, those that have a say at `x`. Both in m; spacing > 0.
  SplineKnots(const Scalar& spacing, const Scalar& x) noexcept
      : spacing_{spacing}, low_{cell(x / spacing) - 1}, high_{low_ + 3} {}

  [[nodiscard]] const Scalar& spacing() const noexcept { return spacing_; }
  [[nodiscard]] int low() const noexcept { return low_; }    ///< index of the first coefficient
  [[nodiscard]] int high() const noexcept { return high_; }  ///< and of the last
  [[nodiscard]] int count() const noexcept { return high_ - low_ + 1; }

  void extend_up() noexcept { ++high_; }
  void extend_down() noexcept { --low_; }

  /// Twice the spacing: the knots with odd indices go; four coefficients stay at least.
  void coarsen() noexcept {
    const int low = inner_low_of_coarse(), high = inner_high_of_coarse();
    spacing_ *= Scalar{2};
    low_ = low - 1;
    high_ = std::max(high, low + 1) + 1;
  }

  /// The outermost knots that stay interior once every second one is gone, as coarse indices.
  [[nodiscard]] int inner_low_of_coarse() const noexcept { return -floor_half(-(low_ + 1)); }
  [[nodiscard]] int inner_high_of_coarse() const noexcept { return floor_half(high_ - 1); }

  /// The index of the cell that x (in spacings) lies in, held where an int ends.
  [[nodiscard]] static int cell(const Scalar& in_spacings) noexcept {
    using std::floor;
    const Scalar most(1'000'000'000);
    if (!(in_spacings > -most)) return -1'000'000'000;
    return static_cast<int>(floor(std::min(in_spacings, most)));
  }

  [[nodiscard]] SplineWeights<Scalar> at(const Scalar& x) const noexcept {
    const auto first = static_cast<Scalar>(low_ + 1), last = static_cast<Scalar>(high_ - 1);
    const Scalar in_spacings = x / spacing_;
    const Scalar inside = std::min(std::max(in_spacings, first), last);
    const int i = std::min(cell(inside), high_ - 2);
    SplineWeights<Scalar> weights = inner(i, inside - Scalar(i));
    if (inside != in_spacings) {
      for (std::size_t k = 0; k < 4; ++k) weights.value[k] += weights.slope[k] * (x - inside * spacing_);
    }
    return weights;
  }

 private:
  static int floor_half(int i) noexcept { return i >= 0 ? i / 2 : -((1 - i) / 2); }

  // In cell i at u of its width.
  [[nodiscard]] SplineWeights<Scalar> inner(int i, const Scalar& u) const noexcept {
    const Scalar a = Scalar{1} - u, sixth = Scalar{1} / Scalar{6}, half = Scalar{1} / Scalar{2};
    const Scalar u2 = u * u, a2 = a * a, per = Scalar{1} / spacing_;
    return {i - 1,
            {sixth * a2 * a, sixth * (Scalar{4} - Scalar{6} * u2 + Scalar{3} * u2 * u),
             sixth * (Scalar{4} - Scalar{6} * a2 + Scalar{3} * a2 * a), sixth * u2 * u},
            {-half * a2 * per, (Scalar{3} * half * u2 - Scalar{2} * u) * per,
             (Scalar{2} * a - Scalar{3} * half * a2) * per, half * u2 * per}};
  }

  Scalar spacing_;
  int low_, high_;
};

}  // namespace limpid
