// SPDX-License-Identifier: MIT
#pragma once

#include "usb_omni_record.hpp"

#include <limpid/core/recent_values.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/usb/usb_omni.hpp>

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>

namespace limpid::examples {

/// What a log came to, beside its rows.
struct OmniLogLosses {
  std::uint64_t rows = 0;
  std::uint64_t unread = 0;     ///< states that came while this program was held up
  std::uint64_t unwritten = 0;  ///< states that came while the file was held up
};

/// Reads an Omni at its own rate, its motors off, for `duration` or until a stop is requested; each state once, by a
/// thread of its own. A fault ends nothing and is cleared, for there is no torque; it stands in the status.
/// @param write  takes the text of some rows at once; what it throws ends the log
[[nodiscard]] OmniLogLosses log_omni(UsbOmni& omni, Duration duration, std::stop_source stop,
                                     const std::function<void(const std::string&)>& write);

}  // namespace limpid::examples
