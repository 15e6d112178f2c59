// SPDX-License-Identifier: MIT
#pragma once

#include "calibrate_options.hpp"
#include "calibrate_report.hpp"

namespace limpid::examples {

/// The tuning run on an Omni on USB: waits until the stylus was docked and drawn out, goes from rest to the sines over
/// 5 s, and fades out. Its torques are within Table 5.1 over the safety factor; it ends, motors off, on a signal, on
/// every fault, and where a joint turns faster than 4 rad/s. Needs libusb. Never run on hardware.
/// @throws UsbError, std::invalid_argument  where there is no device, or no calibration
/// @throws std::runtime_error               where it ended before there was enough to evaluate
[[nodiscard]] CalibrationSection tune_on_usb(const CalibrateOptions& options);

}  // namespace limpid::examples
