// SPDX-License-Identifier: MIT
#include "omni_wire.hpp"

#include <algorithm>
#include <cmath>

namespace limpid::emulator {
namespace {

constexpr double whole_potentiometer = 8000;

std::array<std::uint32_t, 16> nibble_table() {
  std::array<std::uint32_t, 16> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t remainder = i;
    for (int bit = 0; bit < 4; ++bit) remainder = (remainder >> 1U) ^ ((remainder & 1U) != 0 ? 0xedb88320U : 0U);
    table[i] = remainder;
  }
  return table;
}

void put(Bytes& bytes, std::size_t at, std::uint32_t value, int length) {
  for (int i = 0; i < length; ++i)
    bytes[at + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(value >> (8 * i) & 0xffU);
}

std::uint32_t get(std::span<const std::uint8_t> bytes, std::size_t at, int length) {
  std::uint32_t value = 0;
  for (int i = length - 1; i >= 0; --i) value = value << 8U | bytes[at + static_cast<std::size_t>(i)];
  return value;
}

std::uint16_t get_word(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(get(bytes, at, 2));
}

}  // namespace

std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  static const auto table = nibble_table();
  std::uint32_t crc = 0xffffffffU;
  for (const std::uint8_t byte : bytes) {
    crc = (crc >> 4U) ^ table[(crc ^ byte) & 15U];
    crc = (crc >> 4U) ^ table[(crc ^ (byte >> 4U)) & 15U];
  }
  return ~crc;
}

void seal(Bytes& frame) {
  const std::size_t end = frame.size() - 4;
  put(frame, end, crc32(std::span(frame).first(end)), 4);
}

Bytes encode(const OmniFrame& frame) {
  Bytes bytes(state_length, 0);
  bytes[0] = 'L';
  bytes[1] = 'O';
  bytes[2] = 1;
  bytes[3] = 'S';
  put(bytes, 4, frame.sequence, 4);
  put(bytes, 8, frame.time, 4);
  put(bytes, 12, frame.flags, 2);
  put(bytes, 14, frame.boots, 2);

  constexpr std::size_t payload = 16;
  put(bytes, payload + 2, 0x001e, 2);
  constexpr std::array<double, 3> slope{5.48, -5.28, 4.76}, offset{-2.74, 2.64, -2.38};
  for (std::size_t i = 0; i < 3; ++i) {
    put(bytes, payload + 4 + 2 * i, static_cast<std::uint16_t>(frame.counts[i]), 2);
    const double ratio = std::clamp((frame.gimbal[i] - offset[i]) / slope[i], 0.0, 1.0);
    const double a = std::round(ratio * whole_potentiometer);
    put(bytes, payload + 10 + 2 * i, static_cast<std::uint32_t>(a), 2);
    put(bytes, payload + 22 + 2 * i, static_cast<std::uint32_t>(whole_potentiometer - a), 2);
  }
  bytes[payload + 18] = static_cast<std::uint8_t>(frame.sequence & 0xffU);
  bytes[payload + 19] =
      static_cast<std::uint8_t>((frame.pressed[0] ? 0U : 1U) | (frame.pressed[1] ? 0U : 2U) | (frame.docked ? 0U : 4U));
  put(bytes, payload + 20, 0x1007, 2);
  put(bytes, payload + 28, 0x5746, 2);
  put(bytes, payload + 32, frame.sequence, 4);
  put(bytes, payload + 40, frame.sequence / 8, 4);
  seal(bytes);
  return bytes;
}

std::optional<OmniCommand> decode(std::span<const std::uint8_t> packet) {
  if (packet.size() != command_length) return std::nullopt;
  if (packet[0] != 'L' || packet[1] != 'O' || packet[2] != 1 || packet[3] != 'C') return std::nullopt;
  if (get(packet, command_length - 4, 4) != crc32(packet.first(command_length - 4))) return std::nullopt;
  constexpr std::size_t payload = 12;
  const OmniCommand command{
      .sequence = get(packet, 4, 4),
      .watchdog = get_word(packet, 8),
      .dac = {get_word(packet, payload), get_word(packet, payload + 2), get_word(packet, payload + 4)},
      .status = get_word(packet, payload + 6)};
  if (command.watchdog < 1 || command.watchdog > 1000) return std::nullopt;
  return command;
}

}  // namespace limpid::emulator
