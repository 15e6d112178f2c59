// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/sampling.hpp"
#include "prediction/truth.hpp"

#include <cstddef>
#include <vector>

namespace limpid::bench {

/// Where the tool is said to be, tick by tick.
struct TracePoint {
  double x = 0, v = 0, a = 0;  ///< m, m/s, m/s^2; the errors are those of x and v
};
using Trace = std::vector<TracePoint>;

/// What there is to predict from.
struct Course {
  const Truth& truth;
  const std::vector<SensedSample>& samples;
  std::size_t period;  ///< ticks
};

/// Replay from the newest sample's true state with the true law: known at every depth that a sample has visited, its
/// tangent beyond, a wall's damping wherever it touches; a step of the stiffness is known from the first sample taken
/// after it, where the operator rests as he presses again.
[[nodiscard]] Trace floor_trace(const Course& course, const Tissue& tissue, const TissueChange& change);

}  // namespace limpid::bench
