// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/time.hpp>
#include <limpid/device/usb/usb_fault.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace limpid::bench {

/// What became of one fault. Durations are from its onset on.
struct FaultRun {
  bool began = false;                 ///< there was torque before it
  UsbFault stated = UsbFault::none;   ///< what the loop read
  std::optional<Duration> to_stated;  ///< until it read it
  std::optional<Duration> to_zero;    ///< until the motors had no torque, by the device's clock
  bool restarted = false;             ///< torque again, once the cause was gone and the fault was cleared
  bool held_up = false;               ///< the machine held the emulator, or the loop, up for more than 5 ms meanwhile
};

/// A fault, how it must end, and what became of it each time.
struct FaultRow {
  std::string_view name;
  std::vector<UsbFault> expected;  ///< any of them is to be stated; none: it is borne, torque stays
  bool stated = true;              ///< whether there is somebody left to state anything
  std::vector<FaultRun> runs{};
  std::size_t without_torque{};  ///< attempts that had none at the onset, such as after a fault of the machine's making

  [[nodiscard]] bool borne() const { return stated && expected.empty(); }
};

/// Every fault of the emulated Omni, unplugging, and what a host can do, so many times.
[[nodiscard]] std::vector<FaultRow> measure_faults(int repeats);

/// In a process of its own, which preloads umockdev: holds the Omni of the emulated bus with torque, until it is
/// killed.
int hold_until_killed();

}  // namespace limpid::bench
