// SPDX-License-Identifier: MIT
#pragma once

#include "time_error/method.hpp"

#include <vector>

namespace limpid::bench {

/// Time of a method, of many short turns that all methods of its case take one after another.
struct Timing {
  double ns;  ///< a step, median
  /// Over the time of the default in the same scalar, turn by turn: median, lower and upper quartile; NaN where there
  /// is no default.
  double ratio, lower, upper;
};

[[nodiscard]] std::vector<Timing> time_in_turns(std::vector<Method>& methods, int turns);

}  // namespace limpid::bench
