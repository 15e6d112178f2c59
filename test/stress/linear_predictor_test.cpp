// SPDX-License-Identifier: MIT
#include "check.hpp"
#include "predictor_scenario.hpp"

using namespace limpid::stress;

TEST_CASE(
    "on any line, of any tool and linear tissue, every prediction is finite, and without force energy does not grow") {
  check_scenarios(linear_predictor_scenarios(), 50'000, 16'000);
}
