// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/force.hpp"
#include "prediction/tissue.hpp"

#include <limpid/environment/tool.hpp>

#include <vector>

namespace limpid::bench {

inline constexpr double tick_seconds = 0.001;
inline constexpr double tool_mass = 0.1;     // kg
inline constexpr double tool_damping = 0.1;  // N s/m

[[nodiscard]] inline Tool<1> tool() { return {.mass = tool_mass, .damping = tool_damping}; }

/// One tick of what truly happens.
struct TrueTick {
  ToolInTissue::State tool;
  double F_h = 0, F_e = 0;  ///< N

  [[nodiscard]] double acceleration() const { return (F_h - F_e - tool_damping * tool.v) / tool_mass; }  ///< m/s^2
};

/// From rest at the surface, tick by tick, both ends included. A tissue that cannot pull is not pulled at, lest the
/// tool leave it for good.
struct Truth {
  std::vector<TrueTick> ticks;
  double step_at = 0;     ///< half time, s
  double step_shows = 0;  ///< from when on a step of the stiffness moves the tool, s
};

/// @param idle  whether the operator rests around half time
[[nodiscard]] Truth simulate(const Tissue& tissue, const Force& force, const TissueChange& change, double seconds,
                             bool idle = false);

}  // namespace limpid::bench
