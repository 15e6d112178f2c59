// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/summary.hpp"

#include <string>
#include <vector>

namespace limpid::bench {

/// One figure asked of the judged predictor.
struct Finding {
  std::string what;
  double asked = 0, worst = 0;      ///< at most; NaN where nothing could be judged
  std::string where;                ///< of the worst
  std::size_t judged = 0;           ///< cells, or runs
  std::vector<std::string> missed;  ///< where, worst first

  [[nodiscard]] bool met() const { return missed.empty(); }
};

/// A figure and where it was found.
struct Measured {
  double value;
  std::string where;
};

/// What comes of the values that are not NaN.
[[nodiscard]] Finding finding_of(std::string what, double asked, std::vector<Measured> values);

/// For the reader.
[[nodiscard]] std::string tissue_and_period(const Selection& selection, std::size_t tissue, std::size_t period);

/// All figures that the selection says something of: those of the runs that are not held out, then of those that are.
[[nodiscard]] std::vector<Finding> verdict(const Selection& selection, const std::vector<Row>& rows,
                                           const std::vector<Cell>& cells);

}  // namespace limpid::bench
