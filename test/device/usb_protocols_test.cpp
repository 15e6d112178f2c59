// SPDX-License-Identifier: MIT
// What devices say and hear on USB: bytes, without libusb.
#include <limpid/device/usb/crc32.hpp>
#include <limpid/device/usb/falcon.hpp>
#include <limpid/device/usb/little_endian.hpp>
#include <limpid/device/usb/omni_bridge.hpp>

#include "conformance/usb_protocol_suite.hpp"

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

using limpid::Falcon, limpid::FrameFault, limpid::OmniBridge, limpid::UsbProtocol;
using namespace std::chrono_literals;

namespace {

std::vector<std::byte> bytes_of(std::string_view text) {
  std::vector<std::byte> bytes;
  for (const char letter : text) bytes.push_back(static_cast<std::byte>(letter));
  return bytes;
}

std::vector<std::byte> bytes_of(std::initializer_list<unsigned> numbers) {
  std::vector<std::byte> bytes;
  for (const unsigned number : numbers) bytes.push_back(static_cast<std::byte>(number));
  return bytes;
}

// Bit by bit, as the standard has it: not the library's table.
std::uint32_t crc_by_division(std::span<const std::byte> bytes) {
  std::uint32_t rest = 0xFFFF'FFFFU;
  for (const std::byte byte : bytes) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      const bool differs = ((rest ^ (std::to_integer<std::uint32_t>(byte) >> bit)) & 1U) != 0;
      rest = (rest >> 1U) ^ (differs ? 0xEDB8'8320U : 0U);
    }
  }
  return ~rest;
}

void put(std::vector<std::byte>& frame, std::size_t at, std::uint32_t number, unsigned width) {
  for (unsigned i = 0; i < width; ++i) frame[at + i] = static_cast<std::byte>(number >> (8 * i));
}

std::vector<std::byte> omni_state() {
  std::vector<std::byte> frame(64);
  frame[0] = std::byte{'L'};
  frame[1] = std::byte{'O'};
  frame[2] = std::byte{1};
  frame[3] = std::byte{'S'};
  put(frame, 4, 0x0102'0304, 4);   // sequence
  put(frame, 8, 0xFFFF'FFFE, 4);   // us
  put(frame, 12, 1, 2);            // the watchdog has the motors off
  put(frame, 14, 300, 2);          // power-ups
  put(frame, 16, 0x001e'0000, 4);  // the Omni's own, from here on
  put(frame, 20, 0xFFFF, 2);       // -1
  put(frame, 22, 0x8000, 2);       // -32768
  put(frame, 24, 1234, 2);
  put(frame, 26, 100, 2);
  put(frame, 28, 200, 2);
  put(frame, 30, 65'535, 2);
  frame[35] = std::byte{0b010};  // the first button pressed, the second not; docked
  put(frame, 38, 300, 2);
  put(frame, 40, 400, 2);
  put(frame, 42, 1, 2);
  put(frame, 60, crc_by_division(std::span(frame).first(60)), 4);
  return frame;
}

}  // namespace

static_assert(UsbProtocol<OmniBridge>);
static_assert(UsbProtocol<Falcon>);
static_assert(!UsbProtocol<int>);
struct WithoutSafe : OmniBridge {
  static Command safe() = delete;
};
static_assert(!UsbProtocol<WithoutSafe>);

TEST_CASE("the CRC-32 is that of IEEE 802.3") {
  CHECK(limpid::crc32(bytes_of("123456789")) == 0xCBF4'3926U);
  CHECK(limpid::crc32({}) == 0);
  CHECK(limpid::crc32(bytes_of("limpid")) == crc_by_division(bytes_of("limpid")));
}

TEST_CASE("numbers are read and written with their least significant byte first") {
  const auto bytes = bytes_of({0x01, 0x02, 0x03, 0x04});
  CHECK(limpid::load_little_endian<std::uint32_t>(bytes, 0) == 0x0403'0201U);
  CHECK(limpid::load_little_endian<std::uint16_t>(bytes, 1) == 0x0302U);
  std::array<std::byte, 4> written{};
  limpid::store_little_endian(written, 0, std::uint32_t{0x0403'0201U});
  CHECK(std::vector(written.begin(), written.end()) == bytes);
}

TEST_CASE("OmniBridge and Falcon keep the laws of a protocol") {
  limpid::test::check_usb_protocol<OmniBridge>(omni_state());
  limpid::test::check_usb_protocol<Falcon>(bytes_of("\x01\x60<AAAAAAAAAAAAAA>"));
}

TEST_CASE("an Omni's state is read where the wire has it") {
  const auto [state, fault] = OmniBridge::decode(omni_state());
  CHECK(fault == FrameFault::none);
  CHECK(state.sequence == 0x0102'0304);
  CHECK(state.device_time == 0xFFFF'FFFE);
  CHECK(state.boots == 300);
  CHECK(state.watchdog_off);
  CHECK(!state.refuses);
  CHECK(state.encoder == std::array<std::int16_t, 3>{-1, -32'768, 1234});
  CHECK(state.gimbal_a == std::array<std::uint16_t, 3>{100, 200, 65'535});
  CHECK(state.gimbal_b == std::array<std::uint16_t, 3>{300, 400, 1});
  CHECK(state.pressed == std::array{true, false});
  CHECK(state.docked);
}

TEST_CASE("no single wrong bit of an Omni's state passes") {
  const auto frame = omni_state();
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    CAPTURE(bit);
    auto wrong = frame;
    wrong[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    CHECK(OmniBridge::decode(wrong).fault != FrameFault::none);
  }
}

TEST_CASE("each fault of an Omni's frame is named") {
  auto frame = omni_state();
  CHECK(OmniBridge::decode(std::span(frame).first(63)).fault == FrameFault::length);
  frame[2] = std::byte{2};
  put(frame, 60, crc_by_division(std::span(frame).first(60)), 4);
  CHECK(OmniBridge::decode(frame).fault == FrameFault::header);
  frame = omni_state();
  frame[20] ^= std::byte{1};
  CHECK(OmniBridge::decode(frame).fault == FrameFault::checksum);
}

TEST_CASE("an Omni's command stands where the wire has it") {
  const auto frame = OmniBridge::encode({.converter = {0, 2047, 4095}, .motors_on = true}, 0x0102'0304, 20ms);
  auto expected = bytes_of({'L',  'O',  1,    'C',  0x04, 0x03, 0x02, 0x01, 20, 0, 0, 0, 0, 0, 0xff, 0x07,
                            0xff, 0x0f, 0xc8, 0x53, 0,    0,    0,    0,    0,  0, 0, 0, 0, 0, 0,    0});
  put(expected, 28, crc_by_division(std::span(expected).first(28)), 4);
  CHECK(std::vector(frame.begin(), frame.end()) == expected);
}

TEST_CASE("what takes an Omni's motors off is zero on all converters, and motors off") {
  const auto frame = OmniBridge::encode(OmniBridge::safe(), 1, 20ms);
  for (const std::size_t at : {12U, 14U, 16U}) {
    CHECK(limpid::load_little_endian<std::uint16_t>(frame, at) == 0x7ff);
  }
  CHECK(limpid::load_little_endian<std::uint16_t>(frame, 18) == 0x53c0);
}

TEST_CASE("converters and watchdog stay within what the wire can say") {
  const auto frame = OmniBridge::encode({.converter = {65'535, 4096, 4095}}, 1, 2s);
  for (const std::size_t at : {12U, 14U, 16U}) {
    CHECK(limpid::load_little_endian<std::uint16_t>(frame, at) == 4095);
  }
  CHECK(limpid::load_little_endian<std::uint16_t>(frame, 8) == 1000);
  CHECK(limpid::load_little_endian<std::uint16_t>(OmniBridge::encode({}, 1, -1s), 8) == 1);
}

TEST_CASE("steps of an Omni's states count over the end of their numbers, and anew after a power-up") {
  OmniBridge::State from, to;
  from.sequence = 0xFFFF'FFFF;
  to.sequence = 1;
  CHECK(OmniBridge::steps(from, to) == 2);
  CHECK(OmniBridge::steps(from, from) == 0);
  to.boots = 1;
  CHECK(OmniBridge::steps(from, to) == 1);
}

TEST_CASE("a Falcon's state is read from its letters, the last one of a packet") {
  // 0x1234, -1, 0x8000; grip 5, homed 7
  const auto frame = bytes_of(
      "<"
      "EDCB"
      "PPPP"
      "AAAI"
      "\xb6"
      "A>");
  auto packet = bytes_of("\x01\x60");
  packet.insert(packet.end(), frame.begin(), frame.end());
  const auto [state, fault] = Falcon::decode(packet);
  CHECK(fault == FrameFault::none);
  CHECK(state.encoder == std::array<std::int16_t, 3>{0x1234, -1, -32'768});
  CHECK(state.grip == 5);
  CHECK(state.homed == 7);

  auto two = bytes_of("\x01\x60<AAAAAAAAAAAAAA>");
  two.insert(two.end(), frame.begin(), frame.end());
  CHECK(Falcon::decode(two).state.encoder == state.encoder);
}

TEST_CASE("a Falcon's packet without a frame is empty, and what is no letter is refused") {
  CHECK(Falcon::decode(bytes_of("\x01\x60")).fault == FrameFault::empty);
  CHECK(Falcon::decode(bytes_of("\x01")).fault == FrameFault::length);
  CHECK(Falcon::decode(bytes_of("\x01\x60<AAAAAAAAAAAAAA]")).fault == FrameFault::header);
  CHECK(Falcon::decode(bytes_of("\x01\x60<AAAAQAAAAAAAAA>")).fault == FrameFault::value);
}

TEST_CASE("a Falcon's command is in its letters, within the range of its motors") {
  const auto frame = Falcon::encode({.motor = {0x123, -1, 32'767}, .lights = 8, .homing = true}, 0, 0ms);
  CHECK(std::vector(frame.begin(), frame.end()) == bytes_of("<"
                                                            "DCBA"
                                                            "PPPP"
                                                            "AAAB"
                                                            "J"
                                                            "A>"));
}
