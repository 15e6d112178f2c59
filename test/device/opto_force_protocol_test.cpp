// SPDX-License-Identifier: MIT
#include <limpid/device/opto_force_parser.hpp>
#include <limpid/device/opto_force_protocol.hpp>

#include <support/no_allocation.hpp>
#include <support/opto_force_bytes.hpp>

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

using limpid::encode;
using limpid::OptoForceAnswer;
using limpid::OptoForceConfiguration;
using limpid::OptoForceFilter;
using limpid::OptoForceFrame;
using limpid::OptoForceParser;
using limpid::test::answer_bytes;
using limpid::test::Bytes;
using limpid::test::frame_bytes;
using limpid::test::joined;
using namespace std::chrono_literals;

namespace {

struct Found {
  OptoForceParser parser;
  std::vector<OptoForceFrame> frames;
  std::vector<int> answers;

  void take(std::span<const std::uint8_t> bytes) {
    parser.take(
        bytes, [&](const OptoForceFrame& frame) noexcept { frames.push_back(frame); },
        [&](const OptoForceAnswer& answer) noexcept { answers.push_back(answer.error); });
  }
};

Found found_in(const Bytes& bytes) {
  Found found;
  found.take(bytes);
  return found;
}

}  // namespace

TEST_CASE("a frame that was added up by hand is read") {
  // AA 07 08 0A, number 258, status 0, counts 1, -2, 300: the bytes sum up to
  // (170 + 7 + 8 + 10) + (1 + 2) + 0 + 1 + (255 + 254) + (1 + 44) = 753 = 0x02F1
  const Found found = found_in({0xAA, 0x07, 0x08, 0x0A, 0x01, 0x02, 0, 0, 0, 1, 0xFF, 0xFE, 0x01, 0x2C, 0x02, 0xF1});
  REQUIRE(found.frames.size() == 1);
  CHECK(found.frames[0].number == 258);
  CHECK(found.frames[0].status == 0);
  CHECK(found.frames[0].counts == std::array<std::int16_t, 3>{1, -2, 300});
  CHECK(found.parser.counters().frames == 1);
  CHECK(found.parser.counters().skipped == 0);
}

TEST_CASE("counts reach from -32768 to 32767") {
  const Found found = found_in(frame_bytes(0, 0, {-32768, 32767, -1}));
  REQUIRE(found.frames.size() == 1);
  CHECK(found.frames[0].counts == std::array<std::int16_t, 3>{-32768, 32767, -1});
}

TEST_CASE("the status is parted into errors and overloads") {
  CHECK(OptoForceFrame{.status = 0x0000}.errors() == 0);
  CHECK(OptoForceFrame{.status = 0x0000}.overloads() == 0);
  CHECK(OptoForceFrame{.status = 0x0400}.errors() == 0x0400);
  CHECK(OptoForceFrame{.status = 0x0400}.overloads() == 0);
  CHECK(OptoForceFrame{.status = 0x0200}.errors() == 0);
  CHECK(OptoForceFrame{.status = 0x0200}.overloads() == 0x0200);
  CHECK(OptoForceFrame{.status = 0xFFFF}.errors() == 0xFC00);
  CHECK(OptoForceFrame{.status = 0xFFFF}.overloads() == 0x03FF);
}

TEST_CASE("a configuration is encoded as the sensor wants it") {
  // sum 223 + speed + filter + zero
  CHECK(encode({.period = 1ms, .filter = OptoForceFilter::none, .zero = false}) ==
        std::array<std::uint8_t, 9>{0xAA, 0x00, 0x32, 0x03, 1, 0, 0, 0, 224});
  CHECK(encode({.period = 10ms, .filter = OptoForceFilter::hz_15, .zero = true}) ==
        std::array<std::uint8_t, 9>{0xAA, 0x00, 0x32, 0x03, 10, 4, 255, 1, 236});  // 492 = 256 + 236
  CHECK(encode({.period = 255ms, .filter = OptoForceFilter::hz_1_5, .zero = false})[5] == 6);
}

TEST_CASE("settings that the sensor does not have are refused by name") {
  CHECK_THROWS_WITH_AS((void)encode({.period = 0ms}),
                       "OptoForceConfiguration: period: expected 1 to 255 whole milliseconds, got 0 s",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)encode({.period = 256ms}),
                       "OptoForceConfiguration: period: expected 1 to 255 whole milliseconds, got 0.256 s",
                       std::invalid_argument);
  CHECK_THROWS_AS((void)encode({.period = 1500us}), std::invalid_argument);
  CHECK_THROWS_AS((void)encode({.period = -1ms}), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)encode({.filter = static_cast<OptoForceFilter>(7)}),
                       "OptoForceConfiguration: filter: expected one of OptoForceFilter, got 7", std::invalid_argument);
}

TEST_CASE("an answer is told from frames") {
  const Found found =
      found_in(joined(frame_bytes(1, 0, {1, 2, 3}), answer_bytes(0), frame_bytes(2, 0, {4, 5, 6}), answer_bytes(9)));
  CHECK(found.frames.size() == 2);
  CHECK(found.answers == std::vector<int>{0, 9});
  CHECK(found.parser.counters().lost == 0);
}

TEST_CASE("frames are found in pieces of any length") {
  const Bytes bytes = joined(frame_bytes(7, 0, {10, 20, 30}), answer_bytes(0), frame_bytes(8, 0, {-10, -20, -30}));
  for (std::size_t piece = 1; piece <= bytes.size(); ++piece) {
    CAPTURE(piece);
    Found found;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      found.take(std::span(bytes).subspan(at, std::min(piece, bytes.size() - at)));
    }
    CHECK(found.frames.size() == 2);
    CHECK(found.answers.size() == 1);
    CHECK(found.parser.counters().skipped == 0);
  }
}

TEST_CASE("from any byte of a frame on, the next one is found") {
  const Bytes one = frame_bytes(7, 0, {0xAA, 0x7AA, -1}), whole = joined(one, frame_bytes(8, 0, {1, 2, 3}));
  for (std::size_t begin = 1; begin < one.size(); ++begin) {
    CAPTURE(begin);
    const Found found = found_in(Bytes(whole.begin() + static_cast<std::ptrdiff_t>(begin), whole.end()));
    REQUIRE(found.frames.size() == 1);
    CHECK(found.frames[0].number == 8);
    CHECK(found.parser.counters().skipped == one.size() - begin);
  }
}

TEST_CASE("a wrong checksum in any byte costs its frame, and no other") {
  for (std::size_t at = 0; at < 16; ++at) {
    for (const int flip : {0x01, 0x80, 0xFF}) {
      CAPTURE(at);
      CAPTURE(flip);
      Bytes broken = frame_bytes(2, 0, {100, -100, 1000});
      broken[at] = static_cast<std::uint8_t>(broken[at] ^ flip);
      const Found found = found_in(joined(frame_bytes(1, 0, {1, 1, 1}), broken, frame_bytes(3, 0, {3, 3, 3})));
      REQUIRE(found.frames.size() == 2);
      CHECK(found.frames[1].number == 3);
      CHECK(found.parser.counters().bad_checksums == (at < 4 ? 0 : 1));  // else it did not begin like a frame
      CHECK(found.parser.counters().skipped == 16);
      CHECK(found.parser.counters().lost == 1);
    }
  }
}

TEST_CASE("a frame that begins within a broken one is found") {
  const Bytes good = frame_bytes(5, 0, {1, 2, 3}), answer = answer_bytes(0);
  for (std::size_t kept = 4; kept < 16; ++kept) {
    CAPTURE(kept);
    Bytes cut = frame_bytes(4, 0, {9, 9, 9});
    cut.resize(kept);
    const Found found = found_in(joined(cut, good));
    REQUIRE(found.frames.size() == 1);
    CHECK(found.frames[0].number == 5);
    CHECK(found.parser.counters().bad_checksums == 1);
    const Found answered = found_in(joined(cut, answer, good));
    CHECK(answered.answers.size() == 1);
    CHECK(answered.frames.size() == 1);
  }
}

TEST_CASE("lost frames are counted over the end of the counter") {
  Found found = found_in(joined(frame_bytes(65533, 0, {}), frame_bytes(65534, 0, {}), frame_bytes(2, 0, {})));
  CHECK(found.parser.counters().lost == 3);  // 65535, 0, 1
  found.take(frame_bytes(3, 0, {}));
  CHECK(found.parser.counters().lost == 3);
  CHECK(found.parser.counters().restarts == 0);
  CHECK(found.parser.counters().frames == 4);
}

TEST_CASE("a counter that stays or goes back is a restart, and nothing is called lost") {
  Found found = found_in(joined(frame_bytes(1000, 0, {}), frame_bytes(1000, 0, {}), frame_bytes(3, 0, {})));
  CHECK(found.parser.counters().restarts == 2);
  CHECK(found.parser.counters().lost == 0);
  found.take(frame_bytes(5, 0, {}));
  CHECK(found.parser.counters().lost == 1);
}

TEST_CASE("after a new connection the first number follows none, and the rest of the old one is skipped") {
  Found found = found_in(joined(frame_bytes(10, 0, {}), Bytes{0xAA, 0x07, 0x08}));
  found.parser.reconnect();
  found.take(frame_bytes(500, 0, {}));
  CHECK(found.frames.size() == 2);
  CHECK(found.parser.counters().lost == 0);
  CHECK(found.parser.counters().restarts == 0);
  CHECK(found.parser.counters().skipped == 3);
}

TEST_CASE("in garbage nothing is lost sight of: every byte is in a frame, in an answer, skipped or waiting") {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> byte(0, 255), kind(0, 9), length(0, 20);
  Found found;
  std::size_t sent = 0, frames = 0, answers = 0;
  for (unsigned k = 0; k < 5000; ++k) {
    Bytes bytes;
    const int what = kind(random);
    if (what < 5) {
      bytes = frame_bytes(k, 0, {static_cast<int>(k), -1, 170});
      ++frames;
    } else if (what == 5) {
      bytes = answer_bytes(0);
      ++answers;
    } else {
      for (int i = length(random); i > 0; --i) bytes.push_back(static_cast<std::uint8_t>(byte(random)));
    }
    sent += bytes.size();
    found.take(bytes);
  }
  CHECK(found.frames.size() == frames);  // by chance none is faked: 2^-48 each
  CHECK(found.answers.size() == answers);
  const auto known = 16 * frames + 7 * answers + found.parser.counters().skipped;
  CHECK(known <= sent);
  CHECK(sent - known < 16);
}

TEST_CASE("taking bytes does not allocate") {
  const Bytes bytes = joined(frame_bytes(1, 0, {1, 2, 3}), Bytes{0xAA, 0x07, 1, 2}, frame_bytes(3, 0, {1, 2, 3}));
  OptoForceParser parser;
  int frames = 0;
  limpid::test::check_no_allocation([&] {
    parser.take(
        bytes, [&](const OptoForceFrame&) noexcept { ++frames; }, [](const OptoForceAnswer&) noexcept {});
  });
  CHECK(frames == 2);
}
