// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/time.hpp>
#include <limpid/device/usb/crc32.hpp>
#include <limpid/device/usb/little_endian.hpp>
#include <limpid/device/usb/usb_protocol.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace limpid {

/// The Phantom Omni behind a small bridge board on USB: the Omni's own payloads in frames with a checksum. Where what
/// stands in the payloads comes from two public works of reverse engineering of its FireWire link
/// (scottsharris/phantom-drivers, ytsutano/raw_omni) and was not seen on hardware; the frames are limpid's own.
///
/// State, 64 bytes, one a millisecond: 0 "LO", 2 version 1, 3 'S', 4 sequence (u32), 8 the device's time in us (u32),
/// 12 flags, 14 count of power-ups (u16), 16 the Omni's 44 bytes, 60 CRC-32 of what is before it. Command, 32 bytes:
/// "LO", 1, 'C', sequence, 8 the watchdog in ms (u16), 10 zero, 12 the Omni's 16 bytes, 28 CRC-32. Least significant
/// byte first.
///
/// The device takes its motors off by itself where no valid command came for the watchdog's time, and leaves them off
/// until a command with motors off came: a bridge must do so.
/// @realtime  no allocation, no throw
struct OmniBridge {
  struct State {
    std::uint32_t sequence = 0;
    std::uint32_t device_time = 0;            ///< us, wraps
    std::uint16_t boots = 0;                  ///< another number: the encoders count from another zero
    bool watchdog_off = false;                ///< the device's watchdog has taken the motors off
    bool refuses = false;                     ///< until a command with motors off
    std::array<std::int16_t, 3> encoder{};    ///< counts, wrapping
    std::array<std::uint16_t, 3> gimbal_a{};  ///< potentiometers
    std::array<std::uint16_t, 3> gimbal_b{};  ///< about their inverse
    std::array<bool, 2> pressed{};            ///< buttons
    bool docked = false;                      ///< the stylus is in its well
  };

  struct Command {
    std::array<std::uint16_t, 3> converter{zero, zero, zero};  ///< of the motors' D/A converters, up to 4095
    bool motors_on = false;
  };

  static constexpr std::string_view name = "OmniBridge";
  /// pid.codes's number for tests: a board that is given away needs one of its own, see UsbLink's settings.
  static constexpr std::array identities{UsbIdentity{0x1209, 0x0001}};
  static constexpr int interface_number = 0;
  static constexpr UsbTransfer transfer = UsbTransfer::interrupt;
  static constexpr std::uint8_t in_endpoint = 0x81, out_endpoint = 0x01;
  static constexpr std::size_t in_length = 64, out_length = 32;
  static constexpr bool polled = false;
  static constexpr std::uint16_t zero = 0x7ff, highest = 4095;  ///< of the converters

  [[nodiscard]] static std::array<UsbControl, 0> init() noexcept { return {}; }

  [[nodiscard]] static DecodedFrame<State> decode(std::span<const std::byte> frame) noexcept {
    if (frame.size() != in_length) return {{}, FrameFault::length};
    if (!has_header(frame, 'S')) return {{}, FrameFault::header};
    if (load<std::uint32_t>(frame, 60) != crc32(frame.first<60>())) return {{}, FrameFault::checksum};
    return {state_of(frame), FrameFault::none};
  }

  /// @param watchdog  taken to whole milliseconds, from 1 to 1000
  [[nodiscard]] static std::array<std::byte, out_length> encode(const Command& command, std::uint32_t sequence,
                                                                Duration watchdog) noexcept {
    std::array<std::byte, out_length> frame{std::byte{'L'}, std::byte{'O'}, std::byte{version}, std::byte{'C'}};
    const auto milliseconds = std::chrono::floor<std::chrono::milliseconds>(watchdog).count();
    store_little_endian(frame, 4, sequence);
    store_little_endian(frame, 8, static_cast<std::uint16_t>(std::clamp<std::int64_t>(milliseconds, 1, 1000)));
    for (std::size_t i = 0; i < 3; ++i) {
      store_little_endian(frame, 12 + 2 * i, std::min(command.converter[i], highest));
    }
    const unsigned motors = command.motors_on ? motors_bit : 0U;
    store_little_endian(frame, 18, static_cast<std::uint16_t>(status_base | motors));
    store_little_endian(frame, 28, crc32(std::span(frame).first<28>()));
    return frame;
  }

  [[nodiscard]] static Command safe() noexcept { return {}; }

  [[nodiscard]] static std::uint32_t steps(const State& from, const State& to) noexcept {
    return from.boots == to.boots ? to.sequence - from.sequence : 1;
  }

 private:
  static constexpr unsigned char version = 1;
  static constexpr unsigned status_base = 0x53c0, motors_bit = 1U << 3U;
  static constexpr std::size_t payload = 16;  // where the Omni's own state begins

  template <typename Number>
  static Number load(std::span<const std::byte> frame, std::size_t at) noexcept {
    return load_little_endian<Number>(frame, at);
  }

  static bool has_header(std::span<const std::byte> frame, char kind) noexcept {
    return frame[0] == std::byte{'L'} && frame[1] == std::byte{'O'} && frame[2] == std::byte{version} &&
           frame[3] == static_cast<std::byte>(kind);
  }

  static State state_of(std::span<const std::byte> frame) noexcept {
    State state;
    state.sequence = load<std::uint32_t>(frame, 4);
    state.device_time = load<std::uint32_t>(frame, 8);
    const unsigned flags = load<std::uint16_t>(frame, 12);
    state.watchdog_off = (flags & 1U) != 0;
    state.refuses = (flags & 2U) != 0;
    state.boots = load<std::uint16_t>(frame, 14);
    for (std::size_t i = 0; i < 3; ++i) {
      state.encoder[i] = static_cast<std::int16_t>(load<std::uint16_t>(frame, payload + 4 + 2 * i));
      state.gimbal_a[i] = load<std::uint16_t>(frame, payload + 10 + 2 * i);
      state.gimbal_b[i] = load<std::uint16_t>(frame, payload + 22 + 2 * i);
    }
    const auto switches = std::to_integer<unsigned>(frame[payload + 19]);
    state.pressed = {(switches & 1U) == 0, (switches & 2U) == 0};
    state.docked = (switches & 4U) == 0;
    return state;
  }
};

static_assert(UsbProtocol<OmniBridge>);

}  // namespace limpid
