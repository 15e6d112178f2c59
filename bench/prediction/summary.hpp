// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/matrix.hpp"

#include <cstddef>
#include <vector>

namespace limpid::bench {

/// A predictor in one disturbance, tissue and period, over all forces; indices into the selection.
struct Cell {
  bool held_out = false;  ///< of the runs that are, else of the others
  std::size_t disturbance = 0, tissue = 0, period = 0, predictor = 0;
  double early = 0, late = 0;  ///< geometric means
  double worst = 0;            ///< the largest
  std::size_t runs = 0;
};

/// In the order of the fields.
[[nodiscard]] std::vector<Cell> cells_of(const Selection& selection, const std::vector<Row>& rows);

/// The cell of another predictor in the same place.
[[nodiscard]] const Cell& beside(const std::vector<Cell>& cells, const Cell& cell, std::size_t predictor);

/// The predictor that is asked to meet the figures: `chosen`, else `curve`, else the last one selected.
[[nodiscard]] std::size_t judged_predictor(const Selection& selection);

}  // namespace limpid::bench
