// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/trace.hpp"

#include <common/windows.hpp>

#include <cstddef>
#include <vector>

namespace limpid::bench {

using examples::Window;
using examples::window_seconds;
inline constexpr double late_seconds = 8;

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
