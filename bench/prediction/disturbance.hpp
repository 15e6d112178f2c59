// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/sampling.hpp"
#include "prediction/tissue.hpp"

#include <string>
#include <vector>

namespace limpid::bench {

/// What makes a run hard, and what is asked of a prediction there.
struct Disturbance {
  std::string name;
  TissueChange tissue{};  ///< its step comes at half time
  bool idle = false;      ///< whether the operator rests around half time
  Sensing sensing{};
  double late_asked = 0.02;  ///< error over hold's after 8 s, at most

  [[nodiscard]] bool steps() const { return tissue.step != 1; }
};

/// Clean first.
[[nodiscard]] const std::vector<Disturbance>& disturbances();

}  // namespace limpid::bench
