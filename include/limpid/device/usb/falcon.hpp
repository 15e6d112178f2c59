// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/time.hpp>
#include <limpid/device/usb/usb_protocol.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace limpid {

/// The Novint Falcon, whose firmware must have been loaded before by other means: its licence is not free. Frames after
/// libnifalcon (BSD): '<', three int16 as four nibbles each, the least significant first, plus 'A', a byte of lights
/// and homing or of grip and homed axes, plus 'A', another one that is not used, '>'. The chip that joins it to USB
/// puts two bytes of its own before each packet. The device answers each frame with one.
///
/// Frames have no number and no checksum: none is known to be lost or repeated, and a wrong nibble passes where it is
/// one. The device is not known to have a watchdog of its own: what the host does not stop goes on.
/// @realtime  no allocation, no throw
struct Falcon {
  struct State {
    std::array<std::int16_t, 3> encoder{};  ///< counts
    std::uint8_t grip = 0;                  ///< buttons, a bit each
    std::uint8_t homed = 0;                 ///< axes that know their zero, a bit each
  };

  struct Command {
    std::array<std::int16_t, 3> motor{};  ///< -4096 to 4096
    std::uint8_t lights = 0;              ///< 2 green, 4 blue, 8 red, added
    bool homing = false;                  ///< looks for the zero of the encoders, as the arm is moved through its range
  };

  static constexpr std::string_view name = "Falcon";
  static constexpr std::array identities{UsbIdentity{0x0403, 0xcb48}};
  static constexpr int interface_number = 0;
  static constexpr UsbTransfer transfer = UsbTransfer::bulk;
  static constexpr std::uint8_t in_endpoint = 0x81, out_endpoint = 0x02;
  static constexpr std::size_t in_length = 64, out_length = 16;
  static constexpr bool polled = true;
  static constexpr std::int16_t largest = 4096;

  /// Of the chip that joins it to USB (FTDI): what waits is sent after 1 ms; 1.5 Mbaud; both its stores are emptied.
  [[nodiscard]] static std::array<UsbControl, 4> init() noexcept {
    constexpr std::uint8_t vendor_to_device = 0x40, reset = 0x00, baud_rate = 0x03, latency = 0x09;
    return {{{vendor_to_device, latency, 1, 0},
             {vendor_to_device, baud_rate, 2, 0},
             {vendor_to_device, reset, 1, 0},
             {vendor_to_device, reset, 2, 0}}};
  }

  /// Of several frames in a packet the last one.
  [[nodiscard]] static DecodedFrame<State> decode(std::span<const std::byte> packet) noexcept {
    if (packet.size() == modem) return {{}, FrameFault::empty};
    if (packet.size() < modem || (packet.size() - modem) % out_length != 0) return {{}, FrameFault::length};
    const auto frame = packet.last(out_length);
    if (frame.front() != std::byte{'<'} || frame.back() != std::byte{'>'}) return {{}, FrameFault::header};
    State state;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      unsigned counts = 0;
      for (std::size_t i = 4; i-- > 0;) {
        const unsigned nibble = number_of(frame[1 + 4 * axis + i]);
        if (nibble > 0xF) return {{}, FrameFault::value};
        counts = counts << 4U | nibble;
      }
      state.encoder[axis] = static_cast<std::int16_t>(static_cast<std::uint16_t>(counts));
    }
    const unsigned buttons = number_of(frame[13]);
    if (buttons > 0x7F) return {{}, FrameFault::value};
    state.grip = static_cast<std::uint8_t>(buttons & 0xFU);
    state.homed = static_cast<std::uint8_t>(buttons >> 4U);
    return {state, FrameFault::none};
  }

  /// A motor beyond `largest` gets that.
  [[nodiscard]] static std::array<std::byte, out_length> encode(const Command& command, std::uint32_t,
                                                                Duration) noexcept {
    std::array<std::byte, out_length> frame{};
    frame.front() = std::byte{'<'};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int within = command.motor[axis] > largest    ? largest
                         : command.motor[axis] < -largest ? -largest
                                                          : command.motor[axis];
      const auto counts = static_cast<std::uint16_t>(within);
      for (unsigned i = 0; i < 4; ++i) frame[1 + 4 * axis + i] = letter_of(counts >> (4 * i) & 0xFU);
    }
    frame[13] = letter_of((command.lights & 0xEU) | (command.homing ? 1U : 0U));
    frame[14] = letter_of(0);
    frame.back() = std::byte{'>'};
    return frame;
  }

  [[nodiscard]] static Command safe() noexcept { return {}; }

  [[nodiscard]] static std::uint32_t steps(const State&, const State&) noexcept { return 1; }

 private:
  static constexpr std::size_t modem = 2;  // bytes of the chip's own

  static unsigned number_of(std::byte letter) noexcept { return std::to_integer<unsigned>(letter) - 0x41U; }
  static constexpr std::byte letter_of(unsigned nibble) noexcept { return static_cast<std::byte>(0x41U + nibble); }
};

static_assert(UsbProtocol<Falcon>);

}  // namespace limpid
