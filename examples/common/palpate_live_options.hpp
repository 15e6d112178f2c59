// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace limpid::examples {

/// As typed.
struct TypedLive {
  std::string device = "simulated", calibration, usb_path;
  bool realtime = false;
};

void add_live_options(CLI::App& app, TypedLive& typed);

/// Nothing where the run is to be as fast as it can.
/// @param predictors  how many were asked for
/// @throws CLI::ValidationError  where the options contradict each other or the scene
/// @throws std::runtime_error    where the calibration cannot be read
[[nodiscard]] std::optional<LiveSettings> live_of(const CLI::App& app, const TypedLive& typed, const Scene& scene,
                                                  std::size_t predictors);

}  // namespace limpid::examples
