// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/device_verdict.hpp"
#include "prediction/summary.hpp"
#include "prediction/verdict.hpp"

#include <string>
#include <vector>

namespace limpid::bench {

/// What came out of a matrix.
struct Results {
  const Selection& selection;
  std::vector<Row> rows;
  std::vector<Cell> cells;
  std::vector<Finding> findings;
};

void print_tables(const Results& results);
void print_unjudged_windows(const Results& results);
void print_device(const Selection& selection, const DeviceStudy& study);
void print_verdict(const Results& results);

[[nodiscard]] std::string as_csv(const Results& results);  ///< a line for each run of each predictor
/// A line for each press of the arm.
[[nodiscard]] std::string as_device_csv(const Selection& selection, const DeviceStudy& study);
/// Runs with their windows, cells and verdict; the arm's presses and cells.
[[nodiscard]] std::string as_json(const Results& results, const DeviceStudy& study);

/// For each disturbance the judged predictor's late error over the period, and the windows of its worst runs; the
/// files' names.
/// @throws std::runtime_error  where one cannot be written
[[nodiscard]] std::vector<std::string> draw_matrix(const Results& results, const std::string& folder);

}  // namespace limpid::bench
