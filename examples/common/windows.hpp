// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace limpid::examples {

inline constexpr double window_seconds = 4;

/// The error of (x, v) in L2, (3.35), over hold's in a window.
struct Window {
  double start = 0;       ///< s
  double ratio = 0;       ///< NaN where hold has none
  double hold_error = 0;  ///< hold's own, L2
  bool judged = true;     ///< not where hold's own error is below 1 % of its run's mean
};

/// sqrt(sum e^2 tick) over the ticks [begin, end), of squared errors.
[[nodiscard]] double l2(const std::vector<double>& squares, std::size_t begin, std::size_t end, double tick);

/// NaN where hold has no error; infinite where the other's is not finite.
[[nodiscard]] double over_hold(double error, double hold);

/// The whole windows of a run, one after the other; what is left at its end is in none.
/// @param squares, of_hold  squared errors of each tick of [0, n]
/// @param tick              s
[[nodiscard]] std::vector<Window> windows_of(const std::vector<double>& squares, const std::vector<double>& of_hold,
                                             double tick);

}  // namespace limpid::examples
