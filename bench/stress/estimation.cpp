// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include <stress/estimator_scenario.hpp>
#include <stress/law_scenario.hpp>

namespace limpid::stress {

std::vector<Scenario> estimation_part() {
  std::vector<Scenario> all = law_scenarios();
  for (const Scenario& scenario : estimator_scenarios()) all.push_back(scenario);
  return all;
}

}  // namespace limpid::stress
