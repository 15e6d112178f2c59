// SPDX-License-Identifier: MIT
#include "check.hpp"
#include "observer_scenario.hpp"

using namespace limpid::stress;

TEST_CASE("under any input the observer's force and estimate are finite, and a constant disturbance is found") {
  check_scenarios(observer_scenarios(), 100'000, 16'000);
}
