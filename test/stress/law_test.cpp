// SPDX-License-Identifier: MIT
#include "check.hpp"
#include "law_scenario.hpp"

using namespace limpid::stress;

TEST_CASE("under any excitation, clock and gain Gamma stays definite, theta_hat in its box and V does not grow") {
  check_scenarios(law_scenarios(), 100'000, 16'000);
}
