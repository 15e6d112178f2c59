// SPDX-License-Identifier: MIT
#pragma once

#include "weights_options.hpp"
#include "weights_simulation.hpp"

#include <limpid/device/force_calibration_fit.hpp>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace limpid::examples {

/// What was fitted to how many loads, and the sensor they came from where it was simulated.
struct CalibrationFindings {
  CalibrationFit<> fit;
  std::size_t loads = 0;
  std::optional<SimulatedWeights> truth{};
};

[[nodiscard]] std::string words_of(const CalibrationFindings& found);

/// Settings of a ForceCalibration by their names, and how good they are.
[[nodiscard]] nlohmann::ordered_json as_json(const WeightsOptions& options, const CalibrationFindings& found);

}  // namespace limpid::examples
