// SPDX-License-Identifier: MIT
#pragma once

#include "shrink.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace limpid::stress {

/// @throws std::invalid_argument  where there is none
inline const Scenario& named(const std::vector<Scenario>& scenarios, const std::string& name) {
  const auto at =
      std::find_if(scenarios.begin(), scenarios.end(), [&](const Scenario& scenario) { return scenario.name == name; });
  if (at == scenarios.end()) throw std::invalid_argument("no scenario " + name);
  return *at;
}

/// Runs each scenario for `ticks` ticks in trials of `length`; where one breaks, says the smallest case that does.
inline void check_scenarios(std::vector<Scenario> scenarios, std::uint64_t ticks, std::uint64_t length) {
  constexpr std::uint64_t seed = 20170608;
  for (Scenario& scenario : scenarios) {
    scenario.longest = length;
    const Campaign campaign = run(scenario, ticks, seed);
    std::string smallest;
    if (!campaign.outcome.holds()) {
      const Trial trial = shrunk(scenario, campaign.trial);
      smallest = test_case_of(scenario, trial, scenario.play(trial));
    }
    CAPTURE(seed);
    CAPTURE(scenario.name);
    CHECK_MESSAGE(campaign.outcome.holds(), smallest);
  }
}

}  // namespace limpid::stress
