// SPDX-License-Identifier: MIT
// How what was typed becomes numbers, or is refused by its option's name.
#pragma once

#include "number_list.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace limpid::examples {

[[noreturn]] inline void refuse(const std::string& option, const std::string& accepts) {
  throw CLI::ValidationError(option, accepts);
}

[[noreturn]] inline void refuse(const std::string& option, const std::string& accepts, const std::string& got) {
  refuse(option, "accepts " + accepts + ", got " + got);
}

/// What the library refuses, by the option's name.
template <typename Check>
void check_as(const std::string& option, const Check& check) {
  try {
    check();
  } catch (const std::invalid_argument& error) {
    refuse(option, error.what());
  }
}

[[nodiscard]] inline double number(const std::string& option, const std::string& typed, const std::string& accepts,
                                   double least, double most) {
  const auto value = number_of(typed);
  if (!value || *value < least || *value > most) refuse(option, accepts, typed);
  return *value;
}

[[nodiscard]] inline std::vector<double> numbers(const std::string& option, const std::string& typed,
                                                 const std::string& separators, const std::string& accepts) {
  const auto values = numbers_of(typed, separators);
  if (!values) refuse(option, accepts, typed);
  for (const double value : *values) {
    if (!(std::abs(value) <= 1e12)) refuse(option, "numbers of at most 1e12 in magnitude", typed);
  }
  return *values;
}

}  // namespace limpid::examples
