// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/matrix.hpp"
#include "prediction/verdict.hpp"

#include <vector>

namespace limpid::bench {

/// What a tick of the chosen predictor takes, its sample's tick included, us; of several rounds the best.
struct Cost {
  double mean, p999, most;  ///< over a run
};

/// In the first selected tissue, under the first selected force, for each selected period in turn; on this thread,
/// while nothing else of the program runs.
[[nodiscard]] std::vector<Cost> cost_of_chosen(const Selection& selection);

[[nodiscard]] std::vector<Finding> cost_verdict(const Selection& selection, const std::vector<Cost>& costs);

void print_cost(const Selection& selection, const std::vector<Cost>& costs);

}  // namespace limpid::bench
