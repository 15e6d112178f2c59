// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/matrix.hpp"

#include <string>
#include <vector>

namespace limpid::bench {

/// What was asked for, as typed; what is empty is everything, less what is held out.
struct Choice {
  std::vector<std::string> tissues{}, forces{}, disturbances{}, predictors{};
  std::vector<double> periods{0.016, 0.032, 0.1, 0.2};  ///< s
  std::string recordings{};                             ///< a folder; none: empty
  bool held_out = false;                                ///< whether everything includes what is held out
  double seconds = 20;
  bool device = true;  ///< whether an arm follows, too
};

/// @throws std::invalid_argument  where a name is not known, with those that are; where a number is refused
/// @throws std::runtime_error     where the recordings are
[[nodiscard]] Selection selected(const Choice& choice);

}  // namespace limpid::bench
