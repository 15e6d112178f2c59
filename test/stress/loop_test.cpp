// SPDX-License-Identifier: MIT
#include "check.hpp"
#include "loop_scenario.hpp"

using namespace limpid::stress;

TEST_CASE("whatever tool, hand and device say, a whole tick's torque is within its limit, and zero on a fault") {
  check_scenarios(loop_scenarios(), 50'000, 16'000);
}
