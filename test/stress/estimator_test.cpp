// SPDX-License-Identifier: MIT
#include "check.hpp"
#include "estimator_scenario.hpp"

using namespace limpid::stress;

TEST_CASE("on any line the estimate stays in its box and its gain definite") {
  check_scenarios(estimator_scenarios(), 50'000, 16'000);
}
