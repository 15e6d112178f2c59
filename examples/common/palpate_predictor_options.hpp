// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace limpid::examples {

/// As typed.
struct TypedPredictors {
  std::vector<std::string> names{"hold", "model", "ideal"};
  std::vector<double> gain{0, 0}, start;
  bool known = false;
};

void add_predictor_options(CLI::App& app, TypedPredictors& typed);

/// In one order, however they were typed.
/// @throws CLI::ValidationError  where options contradict each other
[[nodiscard]] std::vector<PredictorKind> predictors_of(const CLI::App& app, const TypedPredictors& typed);

/// @throws CLI::ValidationError  where the start is outside the estimate's box
[[nodiscard]] Estimation estimation_of(const TypedPredictors& typed, const Tissue& tissue);

/// @throws CLI::ValidationError  where a predictor cannot serve the scene
void refuse_unserved(const std::vector<PredictorKind>& predictors, const Scene& scene);

}  // namespace limpid::examples
