// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace limpid::bench {

/// What the tool is pressed against: F_e = elastic(x) + damping v.
struct Tissue {
  std::string name;
  std::function<double(double)> elastic;  ///< N, at a depth in m
  double damping = 30;                    ///< N s/m
  std::optional<double> edge{};           ///< m, where contact begins; beyond it F_e >= 0. None: bilateral
  bool smooth = true;                     ///< without kinks
  bool held_out = false;                  ///< kept out of all tuning
};

/// What happens to a tissue during a run.
struct TissueChange {
  double step = 1;            ///< factor on the stiffness from half time on
  bool idle = false;          ///< whether the operator rests around half time
  double softening = 0;       ///< of the stiffness, 1/s
  double relaxation = 0;      ///< K of a Maxwell branch q' = K v - q / lag, N/m
  double lag = 1;             ///< s
  double damping_growth = 0;  ///< N s/m per m of depth
  double friction = 0;        ///< Coulomb's, N

  bool operator==(const TissueChange&) const = default;
};

/// All that are known; those that are held out come last.
[[nodiscard]] const std::vector<Tissue>& tissues();

}  // namespace limpid::bench
