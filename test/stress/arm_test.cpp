// SPDX-License-Identifier: MIT
#include "arm_scenario.hpp"
#include "check.hpp"

using namespace limpid::stress;

TEST_CASE("at any pose, after any reference, the torque is finite, within its limit and no faster than it may be") {
  check_scenarios(arm_scenarios(), 100'000, 16'000);
}
