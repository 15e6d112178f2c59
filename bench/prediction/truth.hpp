// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/force.hpp"
#include "prediction/tool_in_tissue.hpp"

#include <vector>

namespace limpid::bench {

/// One tick of what truly happens.
struct TrueTick {
  ToolInTissue::State tool;
  double F_h = 0, F_e = 0;  ///< N
};

/// From rest at the surface, tick by tick, both ends included. A tissue that cannot pull is not pulled at, lest the
/// tool leave it for good.
struct Truth {
  std::vector<TrueTick> ticks;
  double step_at = 0;     ///< half time, s
  double step_shows = 0;  ///< from when on a step of the stiffness moves the tool, s
};

[[nodiscard]] Truth simulate(const Tissue& tissue, const Force& force, const TissueChange& change, double seconds);

}  // namespace limpid::bench
