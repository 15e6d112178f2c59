// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/force_calibration_fit.hpp>

#include <istream>
#include <string>
#include <vector>

namespace limpid::examples {

/// Weights on a force sensor from a CSV of dx, dy, dz, load, cx, cy, cz: the direction of the force in the sensor's
/// frame, of any length; N along it; the counts. One header is passed over, as are lines that are blank or begin
/// with #.
/// @throws std::runtime_error  "weights.csv: line 3, load: expected a finite number, got ..."
[[nodiscard]] std::vector<CalibrationLoad<>> parse_weights(std::istream& text, const std::string& name);
[[nodiscard]] std::vector<CalibrationLoad<>> load_weights(const std::string& path);

/// The same, as it can be read.
[[nodiscard]] std::string as_csv(const std::vector<CalibrationLoad<>>& loads);

}  // namespace limpid::examples
