// SPDX-License-Identifier: MIT
#include "check.hpp"
#include "line_scenario.hpp"

using namespace limpid::stress;

TEST_CASE("on any line what is held is finite, has arrived, keeps its stamp and grows no older") {
  check_scenarios(line_scenarios(), 200'000, 16'000);
}
