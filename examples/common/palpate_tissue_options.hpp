// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace limpid::examples {

/// As typed; what is absent takes its default from the rest.
struct TypedTissue {
  std::string environment = "kelvin-voigt";
  std::vector<double> stiffness, boundaries{0.0015, 0.0025};
  double depth = 0.0028, sharpness = 20, exponent = 1.3, amplitude = 0.5, growth = 600, damping = 30, wall = 0;
  bool unilateral = false;
};

void add_tissue_options(CLI::App& app, TypedTissue& typed);

/// @throws CLI::ValidationError  where options contradict each other
[[nodiscard]] Tissue tissue_of(const CLI::App& app, const TypedTissue& typed);

}  // namespace limpid::examples
