// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include <stress/predictor_scenario.hpp>

namespace limpid::stress {

std::vector<Scenario> prediction_part() {
  std::vector<Scenario> all = linear_predictor_scenarios();
  for (const Scenario& scenario : nonlinear_predictor_scenarios()) all.push_back(scenario);
  return all;
}

}  // namespace limpid::stress
