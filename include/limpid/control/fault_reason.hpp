// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace limpid {

/// Why a SafetyLimiter gives no torque.
enum class FaultReason {
  none,
  state_not_finite,    ///< a joint's angle or rate was NaN or infinite
  torque_not_finite,   ///< the wanted torque was NaN or infinite
  clock_backwards,     ///< time did not advance since the last call
  gap_too_long,        ///< the last call was too long ago
  joint_out_of_range,  ///< a joint far beyond its limits: its encoder cannot be trusted
  disconnected,        ///< the device does not answer
  upstream,            ///< another block of the tick reported what counts as a fault
};

/// One line for people.
[[nodiscard]] constexpr std::string_view describe(FaultReason reason) noexcept {
  switch (reason) {
    case FaultReason::none:
      return "no fault";
    case FaultReason::state_not_finite:
      return "a joint's angle or rate was not finite";
    case FaultReason::torque_not_finite:
      return "the wanted torque was not finite";
    case FaultReason::clock_backwards:
      return "the clock did not advance";
    case FaultReason::gap_too_long:
      return "too much time passed since the last tick";
    case FaultReason::joint_out_of_range:
      return "a joint was far beyond its limits";
    case FaultReason::disconnected:
      return "the device did not answer";
    case FaultReason::upstream:
      return "a block before the limiter reported a fault";
  }
  return "unknown";
}

}  // namespace limpid
