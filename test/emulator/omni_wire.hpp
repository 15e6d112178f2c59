// SPDX-License-Identifier: MIT
#pragma once

#include "usb_settings.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace limpid::emulator {

/// The device's end of OmniBridge's wire, version 1. It shares no code with the host's end: each tests the other.

constexpr std::size_t state_length = 64, command_length = 32;

/// CRC-32, reflected polynomial 0xEDB88320, start and end inverted.
[[nodiscard]] std::uint32_t crc32(std::span<const std::uint8_t> bytes);

/// What a state frame carries.
struct OmniFrame {
  std::uint32_t sequence = 0;
  std::uint32_t time = 0;  ///< of the device, us
  std::uint16_t flags = 0;
  std::uint16_t boots = 0;
  std::array<std::int16_t, 3> counts{};
  std::array<double, 3> gimbal{};  ///< the device's gimbal angles, rad
  std::array<bool, 2> pressed{};   ///< buttons
  bool docked = false;
};

constexpr std::uint16_t watchdog_has_motors_off = 1, commands_refused = 2;  // flags

[[nodiscard]] Bytes encode(const OmniFrame& frame);
void seal(Bytes& frame);  ///< its last four bytes become the CRC of those before them

/// What a valid command carries.
struct OmniCommand {
  std::uint32_t sequence = 0;
  std::uint16_t watchdog = 0;  ///< ms
  std::array<std::uint16_t, 3> dac{};
  std::uint16_t status = 0;

  [[nodiscard]] bool motors_on() const { return (status & 8U) != 0; }
};

/// Nothing where length, magic, version, kind, CRC or watchdog is wrong.
[[nodiscard]] std::optional<OmniCommand> decode(std::span<const std::uint8_t> packet);

}  // namespace limpid::emulator
