// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace limpid::examples {

struct WeightsOptions {
  std::string weights;  ///< CSV; empty where they are simulated
  bool simulate = false;
  double noise = 0.01;  ///< of a simulated frame, N
  int frames = 100;     ///< averaged for each simulated weight
  std::uint64_t seed = 1;
  double lever_gain = 39.65, lever_arm = 0;  ///< 1/m, m
  double largest_condition = 100;
  std::string json, csv;         ///< files to write; empty: none
  std::optional<int> exit_code;  ///< set where the command line asked for help or was refused (said already)
};

/// Reads the command line of `calibrate_force_sensor`; says on standard error what it refuses and what it would accept.
[[nodiscard]] WeightsOptions parse_weights_options(int argc, const char* const* argv);

}  // namespace limpid::examples
