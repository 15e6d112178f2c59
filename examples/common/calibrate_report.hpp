// SPDX-License-Identifier: MIT
#pragma once

#include "calibrate_ramp.hpp"
#include "calibrate_tuning.hpp"

#include <array>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace limpid::examples {

/// One number of a calibration.
struct CalibrationFigure {
  std::string name;
  double found;                   ///< NaN where it could not be
  std::optional<double> truth{};  ///< of a simulated device
  std::string unit{};
  std::optional<double> deviation{};  ///< standard deviation, where the procedure knows one
};

struct CalibrationSection {
  std::string title;
  std::vector<std::string> notes{};
  std::vector<CalibrationFigure> figures{};
};

/// Conversion (5.5), torque limits, weight and friction; beside the truth of the simulated arm.
[[nodiscard]] CalibrationSection ramp_section(const std::array<RampResult, 3>& joints);

/// The parameters, and friction in motion.
/// @param truth  Table 5.2 and 5.1 where the arm is simulated
[[nodiscard]] CalibrationSection tuning_section(const TuningResult& result, Status status, bool truth);

/// A table with relative errors.
void print_sections(std::ostream& out, const std::vector<CalibrationSection>& sections);

[[nodiscard]] std::string as_json(const std::vector<CalibrationSection>& sections);

}  // namespace limpid::examples
