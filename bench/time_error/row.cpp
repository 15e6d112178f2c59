// SPDX-License-Identifier: MIT
#include "time_error/row.hpp"

#include <cstddef>
#include <sstream>

namespace limpid::bench {

namespace {

// Which way the last bits of a sum fall is luck: errors within a factor of two are taken as equal.
constexpr double error_tie = 2;
// Where the linker happens to put a loop moves its time by some percent.
constexpr double time_tie = 1.05;

bool is_same_race(const Row& a, const Row& b) { return a.place == b.place && a.name == b.name && a.scalar == b.scalar; }

bool is_worse_in_error(const Row& a, const Row& b) { return a.error() > error_tie * b.error(); }

bool is_slower(const Row& a, const Row& b) { return a.time.ns > time_tie * b.time.ns; }

// As `is_slower`, of a default, by the turns one by one: also three quarters of them must say so.
bool default_is_slower(const Row& other) { return other.time.ratio * time_tie < 1 && other.time.upper < 1; }

std::string text_of(const Row& row) {
  std::ostringstream text;
  text.precision(3);
  text << row.place << ", " << row.name << ", " << row.scalar << ": " << row.method << " (" << row.time.ns << " ns, "
       << row.error() << ")";
  return text.str();
}

void check_exact_step(const std::vector<Row>& rows, std::vector<std::string>& broken) {
  for (const Row& row : rows) {
    if (row.place != "predictor step" || row.scalar != "double") continue;
    if (row.is_default && !(row.error() < 1e-14)) broken.push_back(text_of(row) + " errs by 1e-14 or more");
    if (row.method == "Tustin" && default_is_slower(row)) {
      broken.push_back(text_of(row) + " is faster than the exact step");
    }
  }
}

}  // namespace

std::vector<Row> rows_of(const Case& the_case, int turns) {
  std::vector<Method> methods = the_case.methods();
  const std::vector<Timing> timings = time_in_turns(methods, turns);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const Method& m = methods[i];
    rows.push_back({the_case.place, the_case.name, m.name, m.scalar, m.is_default, true, m.truncation_error,
                    m.rounding_error, timings[i]});
  }
  for (Row& row : rows) {
    for (const Row& other : rows) {
      if (row.scalar == other.scalar && is_worse_in_error(row, other) && is_slower(row, other)) row.on_front = false;
    }
  }
  return rows;
}

std::vector<std::string> broken_rules(const std::vector<Row>& rows) {
  std::vector<std::string> broken;
  for (const Row& row : rows) {
    if (!row.is_default) continue;
    for (const Row& other : rows) {
      if (is_same_race(row, other) && is_worse_in_error(row, other) && default_is_slower(other)) {
        broken.push_back(text_of(row) + " is worse in both time and error than " + other.method);
      }
    }
  }
  check_exact_step(rows, broken);
  return broken;
}

}  // namespace limpid::bench
