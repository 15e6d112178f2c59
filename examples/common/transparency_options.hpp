// SPDX-License-Identifier: MIT
#pragma once

#include "decouple.hpp"
#include "transparency_task.hpp"

#include <optional>
#include <string>

namespace limpid::examples {

struct TransparencyOptions {
  TransparencyTask task;
  std::optional<DecoupleOptions> decouple;  ///< where this is asked instead
  std::string json, plot;                   ///< a file and a folder; empty: not written
  std::optional<int> exit_code;             ///< set where the command line asked for help or was refused (said already)
};

/// Reads the command line of `transparency`; says on standard error what it refuses and what it would accept.
[[nodiscard]] TransparencyOptions parse_transparency_options(int argc, const char* const* argv);

}  // namespace limpid::examples
