// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

namespace limpid::examples {

// One source for each kind of predictor.

[[nodiscard]] PalpationResult palpate_with_ideal_signal(const Scene& scene, const ProgressCallback& progress);
/// @param predictor  hold, linear, quadratic or autoregressive
[[nodiscard]] PalpationResult palpate_with_extrapolation(const Scene& scene, PredictorKind predictor,
                                                         const ProgressCallback& progress);
[[nodiscard]] PalpationResult palpate_with_model(const Scene& scene, const ProgressCallback& progress);
[[nodiscard]] PalpationResult palpate_with_replay(const Scene& scene, const ProgressCallback& progress);
[[nodiscard]] PalpationResult palpate_with_smith(const Scene& scene, const ProgressCallback& progress);
/// @param predictor  curve or chosen
[[nodiscard]] PalpationResult palpate_with_learning(const Scene& scene, PredictorKind predictor,
                                                    const ProgressCallback& progress);

}  // namespace limpid::examples
