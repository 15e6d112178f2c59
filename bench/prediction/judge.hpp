// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/trace.hpp"

#include <cstddef>
#include <vector>

namespace limpid::bench {

inline constexpr double window_seconds = 4, late_seconds = 8;

/// The error of (x, v) in L2, (3.35), over hold's in a window.
struct Window {
  double start = 0;       ///< s
  double ratio = 0;       ///< NaN where hold has none
  double hold_error = 0;  ///< hold's own, L2
  bool judged = true;     ///< not where hold's own error is below 1 % of its run's mean
};

/// What a run says of a predictor, each over hold's; NaN where nothing is judged.
struct Figures {
  double early = 0, late = 0, worst = 0;  ///< first window; from `late_from` on; the worst window judged
  std::vector<Window> windows;
};

/// @param late_from  s
[[nodiscard]] Figures judge(const Truth& truth, const Trace& trace, const Trace& hold, double late_from);

/// Of those that are not NaN, none taken below 1e-9; NaN where there is none.
[[nodiscard]] double geometric_mean(const std::vector<double>& values);

}  // namespace limpid::bench
