// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/contenders.hpp"
#include "prediction/disturbance.hpp"
#include "prediction/force.hpp"
#include "prediction/judge.hpp"
#include "prediction/tissue.hpp"

#include <cstddef>
#include <vector>

namespace limpid::bench {

/// What is run with what: every combination.
struct Selection {
  std::vector<Tissue> tissues;
  std::vector<Force> forces;
  std::vector<Disturbance> disturbances;
  std::vector<std::size_t> periods;   ///< ticks
  std::vector<Contender> predictors;  ///< "floor" is added to them
  double seconds = 20;                ///< of a run
};

/// A run of one predictor; indices into the selection.
struct Row {
  std::size_t disturbance = 0, tissue = 0, force = 0, period = 0;
  std::size_t predictor = 0;  ///< the floor's is the number of predictors
  Figures figures;
};

/// All runs, ordered as the fields of a row; the same whatever the number of threads.
/// @throws  what a run throws
[[nodiscard]] std::vector<Row> run_matrix(const Selection& selection, unsigned threads);

[[nodiscard]] bool held_out(const Selection& selection, const Row& row);
[[nodiscard]] const std::string& predictor_name(const Selection& selection, std::size_t predictor);

}  // namespace limpid::bench
