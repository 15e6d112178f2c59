// SPDX-License-Identifier: MIT
#include "check.hpp"
#include "predictor_scenario.hpp"

using namespace limpid::stress;

TEST_CASE("on any line, of any tool and nonlinear tissue, every prediction is finite") {
  check_scenarios(nonlinear_predictor_scenarios(), 50'000, 16'000);
}
