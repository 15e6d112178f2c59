// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/haptic_device.hpp>
#include <limpid/device/usb/omni_bridge.hpp>

#include <array>
#include <cstdint>
#include <string>

namespace limpid::examples {

/// One state of an Omni, as omni_log writes it; trivially copyable, so that it can go from thread to thread.
struct OmniRecord {
  double time = 0;                              ///< since the log's begin, s
  std::array<double, 3> q{}, qdot{}, gimbal{};  ///< rad, rad/s, rad
  std::uint32_t buttons = 0;                    ///< a bit each
  std::array<std::int16_t, 3> counts{};         ///< of the encoders
  bool docked = false, calibrated = false;      ///< without the latter q, q' are zero
  std::uint32_t sequence = 0;                   ///< by the device
  std::uint32_t device_time = 0;                ///< us, wraps
  std::uint32_t status = 0;                     ///< bits of Status
};

/// @realtime  no allocation, no throw
[[nodiscard]] OmniRecord record_of(const DeviceState<3>& seen, const OmniBridge::State& state, bool calibrated,
                                   Time begin) noexcept;

/// The names of the columns, a line.
[[nodiscard]] std::string omni_record_header();

/// A line; status in words, joined by '+'.
[[nodiscard]] std::string csv_line(const OmniRecord& record);

}  // namespace limpid::examples
