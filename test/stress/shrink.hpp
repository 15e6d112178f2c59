// SPDX-License-Identifier: MIT
#pragma once

#include "trial.hpp"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <string>

namespace limpid::stress {

/// The simplest trial, as far as bisection finds it, that still breaks an invariant where `trial` breaks one: each
/// choice as near to 0 as may be, no tick after the break, and as many as possible left out before it.
inline Trial shrunk(const Scenario& scenario, Trial trial) {
  const auto breaks = [&](Trial candidate) {
    const Outcome outcome = scenario.play(candidate);
    if (outcome.holds()) return false;
    candidate.ticks = outcome.tick + 1;
    trial = candidate;
    return true;
  };
  if (!breaks(trial)) return trial;
  for (std::size_t k = 0; k < scenario.choices.size(); ++k) {
    for (int simpler = 0; simpler < trial.choices[k]; ++simpler) {
      Trial candidate = trial;
      candidate.choices[k] = simpler;
      candidate.ticks = std::max<std::uint64_t>(trial.ticks, 10'000);  // it may break later
      if (breaks(candidate)) break;
    }
  }
  // Breaking need not be monotone in what is left out: halve the stride each time that a leap fails.
  for (std::uint64_t stride = trial.ticks - trial.skip; stride > 0; stride /= 2) {
    while (trial.skip + stride < trial.ticks) {
      Trial candidate = trial;
      candidate.skip += stride;
      if (!breaks(candidate)) break;
    }
  }
  return trial;
}

/// A trial with a seed, and choices by it.
inline Trial drawn_trial(const Scenario& scenario, std::uint64_t seed, std::uint64_t ticks) {
  Random random(seed);
  Trial trial{.seed = random.bits(), .ticks = ticks};
  for (std::size_t k = 0; k < scenario.choices.size(); ++k) {
    trial.choices[k] = random.below(static_cast<int>(scenario.choices[k].kinds.size()));
  }
  return trial;
}

/// The trial as a test; `list` is the header's function that has the scenario.
inline std::string test_case_of(const Scenario& scenario, const Trial& trial, const Outcome& outcome) {
  std::ostringstream text;
  text << "TEST_CASE(\"" << scenario.name << ": " << outcome.broken << "\") {\n  //";
  for (std::size_t k = 0; k < scenario.choices.size(); ++k) {
    const Choice& choice = scenario.choices[k];
    text << ' ' << choice.name << ": " << choice.kinds[static_cast<std::size_t>(trial.choices[k])] << ';';
  }
  text << "\n  CHECK(named(\"" << scenario.name << "\").play({.seed = " << trial.seed << "ULL, .ticks = " << trial.ticks
       << ", .skip = " << trial.skip << ", .choices = {";
  for (std::size_t k = 0; k < scenario.choices.size(); ++k) text << (k > 0 ? ", " : "") << trial.choices[k];
  text << "}}).holds());\n}\n";
  return text.str();
}

/// Trials of `ticks` ticks in all, every eighth as long as they may be, the others a sixteenth of that; until one
/// breaks.
struct Campaign {
  Outcome outcome;  ///< figures of all trials; of the one that broke, the rest
  Trial trial;      ///< that broke
};

inline Campaign run(const Scenario& scenario, std::uint64_t ticks, std::uint64_t seed) {
  Campaign campaign;
  Random seeds(seed);
  std::uint64_t count = 0;
  for (std::uint64_t done = 0; done < ticks && campaign.outcome.holds();) {
    const std::uint64_t whole = ++count % 8 == 0 ? scenario.longest : scenario.longest / 16;
    const std::uint64_t length = std::min(whole, ticks - done);
    campaign.trial = drawn_trial(scenario, seeds.bits(), length);
    Outcome outcome = scenario.play(campaign.trial);
    done += length;
    const Outcome& before = campaign.outcome;
    for (std::size_t i = 0; i < before.figure_count; ++i) outcome.note(before.figures[i].name, before.figures[i].worst);
    outcome.ticks += before.ticks;
    campaign.outcome = outcome;
  }
  return campaign;
}

}  // namespace limpid::stress
