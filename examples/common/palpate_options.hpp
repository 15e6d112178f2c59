// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace limpid::examples {

struct PalpateOptions {
  Scene scene;
  std::vector<PredictorKind> predictors;
  std::string json, csv, plot;   ///< paths; empty: not written
  std::optional<int> exit_code;  ///< set where the command line asked for help or was refused (said already)
};

/// Reads the command line of `palpate`; says on standard error what it refuses and what it would accept.
/// @throws std::runtime_error  where the recording cannot be read
[[nodiscard]] PalpateOptions parse_palpate_options(int argc, const char* const* argv);

}  // namespace limpid::examples
