// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <CLI/CLI.hpp>

#include <vector>

namespace limpid::examples {

/// As typed; none by default.
struct TypedDisturbances {
  double force_noise = 0, soften = 0, jitter = 0, loss = 0, depth_damping = 0, coulomb = 0;
  std::vector<double> state_noise{0, 0}, quantise{0, 0}, stiffness_step{0, 1}, relaxation{0, 1};
  std::uint32_t seed = 1;
};

void add_disturbance_options(CLI::App& app, TypedDisturbances& typed);

/// @param duration  of the run, s
/// @throws CLI::ValidationError  where one cannot last for the run
[[nodiscard]] Disturbances disturbances_of(const TypedDisturbances& typed, double duration);

}  // namespace limpid::examples
