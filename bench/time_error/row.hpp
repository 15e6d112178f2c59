// SPDX-License-Identifier: MIT
#pragma once

#include "time_error/method.hpp"
#include "time_error/timing.hpp"

#include <string>
#include <vector>

namespace limpid::bench {

/// A method that has been run.
struct Row {
  std::string place, name, method, scalar;  ///< name: of the case
  bool is_default, on_front;
  double truncation_error, rounding_error;  ///< relative
  Timing time;

  [[nodiscard]] double error() const { return truncation_error + rounding_error; }
};

/// All methods of a case, timed, with those marked that no other one of the same scalar beats in both time and error.
[[nodiscard]] std::vector<Row> rows_of(const Case& the_case, int turns);

/// What the rows break of: no default is worse than another method of its scalar in both time and error; the exact
/// step takes no longer than Tustin's and errs by less than 1e-14 in double. One sentence each.
[[nodiscard]] std::vector<std::string> broken_rules(const std::vector<Row>& rows);

void print_table(const std::vector<Row>& rows);
[[nodiscard]] std::string as_csv(const std::vector<Row>& rows);
[[nodiscard]] std::string as_json(const std::vector<Row>& rows, int turns, const std::vector<std::string>& broken);

/// A work-precision diagram of each place into `folder`, with gnuplot; its file names.
/// @throws std::runtime_error  where one cannot be written
std::vector<std::string> draw_work_precision(const std::vector<Row>& rows, const std::string& folder);

}  // namespace limpid::bench
