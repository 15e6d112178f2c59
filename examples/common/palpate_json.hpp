// SPDX-License-Identifier: MIT
#pragma once

#include "palpate_report.hpp"
#include "scene.hpp"

#include <string>
#include <vector>

namespace limpid::examples {

/// The settings, and the figures of each predictor.
/// @param hold  whose errors the windows are judged by; null: there are no windows
[[nodiscard]] std::string as_json(const Scene& scene, const std::vector<PalpationRun>& runs,
                                  const PalpationResult* hold);

}  // namespace limpid::examples
