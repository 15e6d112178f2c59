// SPDX-License-Identifier: MIT
#pragma once

#include "design_options.hpp"
#include "heat_map.hpp"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace limpid::examples {

/// What `design_gain` found, for a machine and in words.
struct DesignReport {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  std::string words{};
  std::optional<AffineGain<>> gain{};  ///< judged or found: what a plot is drawn of
};

[[nodiscard]] DesignReport solve(const DesignTask& task);
[[nodiscard]] DesignReport verify(const DesignTask& task);
[[nodiscard]] DesignReport robust(const DesignTask& task);

/// @param progress  takes the fraction done
[[nodiscard]] DesignReport map_gain(const DesignTask& task, const std::function<void(double)>& progress,
                                    HeatMap* plot = nullptr);

}  // namespace limpid::examples
