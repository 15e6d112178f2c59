// SPDX-License-Identifier: MIT
#pragma once

#include "random.hpp"
#include "watch.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace limpid::stress {

/// One run of a scenario: all that decides it.
struct Trial {
  static constexpr std::size_t most_choices = 8;

  std::uint64_t seed = 0;
  std::uint64_t ticks = 0;
  std::uint64_t skip = 0;                   ///< ticks at the start that the component does not see
  std::array<int, most_choices> choices{};  ///< of each of the scenario's choices; 0 is the simplest
};

/// What a trial may choose among, the simplest first.
struct Choice {
  std::string name;
  std::vector<std::string> kinds;
};

/// A component, what is done to it and what must hold.
struct Scenario {
  std::string name;
  std::vector<Choice> choices;
  Outcome (*play)(const Trial&);
  double share = 1;                ///< of the ticks of all scenarios, in parts of their sum
  std::uint64_t longest = 80'000;  ///< ticks of a trial
};

/// Calls `tick(now_is_seen, random)` for each tick of a trial until an invariant breaks. What is drawn at a tick does
/// not depend on whether it is seen, so that leaving out the first ones leaves the others as they were.
template <typename Tick>
Outcome play_ticks(const Trial& trial, Watch& watch, Tick tick) {
  Random random(trial.seed);
  for (std::uint64_t i = 0; i < trial.ticks && !watch.broken(); ++i) {
    const bool seen = i >= trial.skip;
    if (seen) watch.start(i);
    tick(seen, random);
  }
  return watch.outcome();
}

}  // namespace limpid::stress
