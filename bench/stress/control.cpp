// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include <stress/arm_scenario.hpp>
#include <stress/kinematics_scenario.hpp>
#include <stress/line_scenario.hpp>
#include <stress/loop_scenario.hpp>
#include <stress/observer_scenario.hpp>

namespace limpid::stress {

std::vector<Scenario> control_part() {
  std::vector<Scenario> all = line_scenarios();
  for (const auto& part : {kinematics_scenarios(), arm_scenarios(), observer_scenarios(), loop_scenarios()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace limpid::stress
