// SPDX-License-Identifier: MIT
#pragma once

#include "calibrate_tuning.hpp"

#include <optional>
#include <string>

namespace limpid::examples {

struct CalibrateOptions {
  bool usb = false;                  ///< a device, and not the simulated one
  std::string path, id;              ///< of the device on USB; empty: there is only one, and the protocol's own
  double watchdog = 20;              ///< its, ms
  bool ramps = true, tuning = true;  ///< which procedures
  TuningTask::Settings run{};        ///< of the tuning run
  std::string calibration;           ///< path; empty: none
  std::string measured, write;       ///< torques to compute the scale from, and the calibration that they give
  std::string json;
  std::optional<int> exit_code;  ///< set where the command line asked for help or was refused (said already)
};

/// Reads the command line of `omni_calibrate`; says on standard error what it refuses and what it would accept.
[[nodiscard]] CalibrateOptions parse_calibrate_options(int argc, const char* const* argv);

}  // namespace limpid::examples
