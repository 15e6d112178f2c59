// SPDX-License-Identifier: MIT
#include "check.hpp"
#include "kinematics_scenario.hpp"

using namespace limpid::stress;

TEST_CASE("for any target the joints are finite and within their limits, and exact where they say so") {
  check_scenarios(kinematics_scenarios(), 100'000, 16'000);
}
