// SPDX-License-Identifier: MIT
// Any bytes as a packet from a device on USB; the first byte chooses which, and whether a right checksum is put under
// an Omni's. What is accepted is what the bytes say, and says the same again where it is encoded once more.
#include <limpid/device/usb/falcon.hpp>
#include <limpid/device/usb/omni_bridge.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace {

using Bytes = std::vector<std::uint8_t>;
using limpid::FrameFault;

void require(bool holds) {
  if (!holds) __builtin_trap();
}

// CRC-32 bit by bit, by the polynomial as it is printed, without a table: each byte and the result mirrored.
std::uint32_t plain_crc(std::span<const std::uint8_t> bytes) {
  const auto mirrored = [](std::uint32_t number, int bits) {
    std::uint32_t other = 0;
    for (int i = 0; i < bits; ++i) other = other << 1U | (number >> static_cast<unsigned>(i) & 1U);
    return other;
  };
  std::uint32_t rest = 0xFFFF'FFFF;
  for (const std::uint8_t byte : bytes) {
    rest ^= mirrored(byte, 8) << 24U;
    for (int bit = 0; bit < 8; ++bit) rest = rest >> 31U != 0 ? rest << 1U ^ 0x04C1'1DB7U : rest << 1U;
  }
  return mirrored(~rest, 32);
}

std::uint32_t number(const Bytes& bytes, std::size_t at, std::size_t length) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < length; ++i) sum += static_cast<std::uint32_t>(bytes[at + i]) << (8 * i);
  return sum;
}

void put_crc(Bytes& frame) {
  const std::uint32_t crc = plain_crc(std::span(frame).first(60));
  for (std::size_t i = 0; i < 4; ++i) frame[60 + i] = static_cast<std::uint8_t>(crc >> (8 * i));
}

// The parts of a frame that a state is of, put in their places again.
void check_omni(const Bytes& frame) {
  const auto [state, fault] = limpid::OmniBridge::decode(std::as_bytes(std::span(frame)));
  const bool whole = frame.size() == 64 && frame[0] == 'L' && frame[1] == 'O' && frame[2] == 1 && frame[3] == 'S' &&
                     number(frame, 60, 4) == plain_crc(std::span(frame).first(60));
  require((fault == FrameFault::none) == whole);
  if (!whole) return;
  require(state.sequence == number(frame, 4, 4) && state.device_time == number(frame, 8, 4));
  require(state.boots == number(frame, 14, 2));
  require((state.watchdog_off ? 1U : 0U) + (state.refuses ? 2U : 0U) == number(frame, 12, 2) % 4);
  for (std::size_t i = 0; i < 3; ++i) {
    require(static_cast<std::uint16_t>(state.encoder[i]) == number(frame, 20 + 2 * i, 2));
    require(state.gimbal_a[i] == number(frame, 26 + 2 * i, 2) && state.gimbal_b[i] == number(frame, 38 + 2 * i, 2));
  }
  require((state.pressed[0] ? 0 : 1) + (state.pressed[1] ? 0 : 2) + (state.docked ? 0 : 4) == frame[35] % 8);
}

// The last frame of the packet, its unused letter aside, is what encoding its numbers gives.
void check_falcon(const Bytes& packet) {
  const auto [state, fault] = limpid::Falcon::decode(std::as_bytes(std::span(packet)));
  require((fault == FrameFault::empty) == (packet.size() == 2));
  if (fault != FrameFault::none) return;
  require(packet.size() > 2 && (packet.size() - 2) % 16 == 0);
  Bytes again(16, 'A');
  again.front() = '<';
  again.back() = '>';
  for (std::size_t axis = 0; axis < 3; ++axis) {
    int left = state.encoder[axis] < 0 ? state.encoder[axis] + 65'536 : state.encoder[axis];
    for (std::size_t i = 0; i < 4; ++i, left /= 16)
      again[1 + 4 * axis + i] = static_cast<std::uint8_t>('A' + left % 16);
  }
  again[13] = static_cast<std::uint8_t>('A' + state.grip + 16 * state.homed);
  const auto frame = std::span(packet).last(16);
  again[14] = frame[14];
  require(std::ranges::equal(again, frame));
  const limpid::Falcon::Command command{.motor = state.encoder};
  const auto encoded = limpid::Falcon::encode(command, 0, {});
  const bool within = std::ranges::all_of(state.encoder, [](int counts) { return counts >= -4096 && counts <= 4096; });
  for (std::size_t i = 0; within && i < 13; ++i) require(std::to_integer<std::uint8_t>(encoded[i]) == frame[i]);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  Bytes packet(data + 1, data + size);
  if (data[0] % 3 == 2) return check_falcon(packet), 0;
  if (data[0] % 3 == 1 && packet.size() == 64) put_crc(packet);
  check_omni(packet);
  return 0;
}
