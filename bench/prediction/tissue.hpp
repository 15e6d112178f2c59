// SPDX-License-Identifier: MIT
#pragma once

#include <common/tool_in_tissue.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace limpid::bench {

using examples::TissueChange;
using examples::TissueForce;
using examples::ToolInTissue;

/// What the tool is pressed against: F_e = elastic(x) + damping v.
struct Tissue {
  std::string name;
  std::function<double(double)> elastic;  ///< N, at a depth in m
  double damping = 30;                    ///< N s/m
  std::optional<double> edge{};           ///< m, where contact begins; beyond it F_e >= 0. None: bilateral
  bool smooth = true;                     ///< without kinks
  bool held_out = false;                  ///< kept out of all tuning

  [[nodiscard]] examples::UndisturbedForce force() const { return {elastic, damping, edge}; }
};

/// All that are known; those that are held out come last.
[[nodiscard]] const std::vector<Tissue>& tissues();

}  // namespace limpid::bench
