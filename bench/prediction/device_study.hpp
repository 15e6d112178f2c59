// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/device_press.hpp"
#include "prediction/matrix.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace limpid::bench {

/// Presses that an Omni follows, all undisturbed.
struct DeviceScenario {
  std::string name;
  Follower follower, of_hold;  ///< of the judged predictor and the true signal; of hold
  std::vector<Force> forces;
  std::vector<std::size_t> tissues;  ///< of the selection
  bool ends_at_rest = false;         ///< whether the force stays in the end: only motion is judged

  [[nodiscard]] bool realistic() const { return follower != Follower::ideal; }
};

/// The ideal arm in all tissues; the realistic one in A and B, with the whole force, with two thirds of it, and with a
/// force that stays in the end. Where the arm starts its motors bear 1.9 N of pull, and 1.3 N of pressing where joint 2
/// overcomes its friction.
[[nodiscard]] std::vector<DeviceScenario> device_scenarios(const Selection& selection);

/// One press; indices into the scenarios, the selection, and the scenario's forces.
struct DeviceRow {
  std::size_t scenario = 0, tissue = 0, period = 0, force = 0;
  Press judged, ideal, hold;  ///< of the judged predictor, the true signal, and hold
  Press hold_as_judged;       ///< hold, followed as the others are

  /// Whether the force alone leads the arm to the end of its reach: then nothing is judged.
  [[nodiscard]] bool out_of_reach() const { return ideal.out_of_reach() || hold.out_of_reach(); }
};

/// All of them, ordered as the fields of a row; the same whatever the number of threads.
/// @throws  what a run throws
[[nodiscard]] std::vector<DeviceRow> run_device(const Selection& selection,
                                                const std::vector<DeviceScenario>& scenarios, unsigned threads);

}  // namespace limpid::bench
