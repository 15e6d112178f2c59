// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace limpid::bench {

/// How the operator presses: at most 3 N.
struct Force {
  std::string name;
  std::function<double(double)> at;  ///< N, at a time in s
  bool held_out = false;             ///< kept out of all tuning
};

/// The forces that are closed forms.
[[nodiscard]] std::vector<Force> synthetic_forces();

/// Every CSV file of a folder (time in s, force) in the order of their names, scaled to 3 N at most; named as the file,
/// without `press_` before it.
/// @throws std::runtime_error  where the folder or a file cannot be read, or has no force above zero
[[nodiscard]] std::vector<Force> recorded_forces(const std::string& folder);

}  // namespace limpid::bench
