// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace limpid {

/// Why a device on USB has no torque until its fault is cleared, deliberately.
enum class UsbFault {
  none,
  disconnected,    ///< it was unplugged, or stopped to answer for good
  stale,           ///< no new state came in time
  loop_silent,     ///< the loop gave no new command in time: the host's watchdog
  device_silent,   ///< commands did not get through to the device in time
  watchdog_off,    ///< the device's own watchdog has taken its motors off
  power_cycled,    ///< the device was without power: its encoders count from another zero
  encoder_jumped,  ///< an angle changed faster than a joint can turn
};

/// One line for people.
[[nodiscard]] constexpr std::string_view describe(UsbFault fault) noexcept {
  switch (fault) {
    case UsbFault::none:
      return "no fault";
    case UsbFault::disconnected:
      return "the device was unplugged or does not answer";
    case UsbFault::stale:
      return "no new state came from the device in time";
    case UsbFault::loop_silent:
      return "the loop gave no new command in time";
    case UsbFault::device_silent:
      return "commands did not reach the device in time";
    case UsbFault::watchdog_off:
      return "the device's watchdog took its motors off";
    case UsbFault::power_cycled:
      return "the device was without power and must be docked again";
    case UsbFault::encoder_jumped:
      return "an encoder changed faster than its joint can turn";
  }
  return "unknown";
}

}  // namespace limpid
