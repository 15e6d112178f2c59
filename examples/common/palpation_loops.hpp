// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <functional>

namespace limpid::examples {

// One source each: a loop for every kind of predictor and tissue.
[[nodiscard]] PalpationResult palpate_with_hold(const Scene& scene, const std::function<void(double)>& progress);
[[nodiscard]] PalpationResult palpate_with_ideal_signal(const Scene& scene,
                                                        const std::function<void(double)>& progress);
[[nodiscard]] PalpationResult palpate_with_known_model(const Scene& scene, const std::function<void(double)>& progress);
[[nodiscard]] PalpationResult palpate_with_estimated_model(const Scene& scene,
                                                           const std::function<void(double)>& progress);

}  // namespace limpid::examples
