// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/design_point.hpp>

#include <cmath>
#include <cstddef>

namespace limpid {

/// The values first, first + step, ..., last, both ends included.
template <Real Scalar = double>
struct GridSide {
  Scalar first{0}, step{1}, last{0};  ///< in one unit; first <= last, step > 0, last - first a whole number of steps

  static constexpr double most = 1e6;  ///< values of a side

  /// @throws std::invalid_argument  where the three do not make a side of at most `most` values
  void check() const {
    expect(is_finite(first), "GridSide: first", "finite", first);
    expect(is_finite(last) && first <= last, "GridSide: last", "finite and >= first", last);
    expect(is_finite(step) && step > Scalar{0}, "GridSide: step", "finite and > 0", step);
    const Scalar steps = (last - first) / step;
    expect(steps < Scalar(most), "GridSide: step", "one that leads to last within a million steps", step);
    const Scalar whole = nearest(steps), miss = steps - whole;
    const Scalar tolerance = Scalar{1} / Scalar{1000};  // of a step: 0.1 has no exact binary form, sums of it drift
    expect(-tolerance <= miss && miss <= tolerance, "GridSide: step", "one that leads from first to last", step);
  }

  /// How many values; 0 where `check` would throw for the order of the ends, the step or their number.
  [[nodiscard]] std::size_t size() const {
    if (!(step > Scalar{0}) || !(first <= last) || !((last - first) / step < Scalar(most))) return 0;
    return static_cast<std::size_t>(nearest((last - first) / step)) + 1;
  }

  /// Value `i`; the ends are exact.
  [[nodiscard]] Scalar operator[](std::size_t i) const {
    const std::size_t steps = size() - 1;
    if (i == 0) return first;
    return i == steps ? last : first + (last - first) * Scalar(i) / Scalar(steps);
  }

 private:
  static Scalar nearest(const Scalar& value) {
    using std::floor;
    return floor(value + Scalar{1} / Scalar{2});
  }
};

/// Tissues on a rectangular grid. Cells run along the damping first: cell `row * columns() + column` has stiffness
/// `row` and damping `column`, so that neighbours in a row differ little.
template <Real Scalar = double>
struct Grid {
  GridSide<Scalar> stiffness{};  ///< N/m
  GridSide<Scalar> damping{};    ///< N s/m

  static constexpr std::size_t most = 100'000'000;  ///< cells

  /// @throws std::invalid_argument  where a side is refused, or there are more than `most` cells
  void check() const {
    stiffness.check();
    damping.check();
    expect(size() <= most, "Grid: cells", "a hundred million or fewer", size());
  }

  [[nodiscard]] std::size_t rows() const { return stiffness.size(); }
  [[nodiscard]] std::size_t columns() const { return damping.size(); }
  [[nodiscard]] std::size_t size() const { return rows() * columns(); }

  [[nodiscard]] Tissue<Scalar> at(std::size_t row, std::size_t column) const {
    return {stiffness[row], damping[column]};
  }
  [[nodiscard]] Tissue<Scalar> operator[](std::size_t cell) const { return at(cell / columns(), cell % columns()); }

  /// From the first corner to the last.
  [[nodiscard]] TissueBox<Scalar> box() const {
    return {{stiffness.first, damping.first}, {stiffness.last, damping.last}};
  }
};

}  // namespace limpid
