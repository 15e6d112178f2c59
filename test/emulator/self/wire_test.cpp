// SPDX-License-Identifier: MIT
#include <emulator/omni_board.hpp>
#include <emulator/self/command.hpp>

#include <doctest/doctest.h>

using namespace limpid;
using namespace limpid::emulator;
using std::chrono::milliseconds;

TEST_CASE("the CRC is that of the nine digits") {
  const Bytes digits{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  CHECK(crc32(digits) == 0xcbf43926U);
}

TEST_CASE("a state frame has its fields where the wire has them") {
  const Bytes frame = encode({.sequence = 0x01020304,
                              .time = 0x11121314,
                              .flags = 3,
                              .boots = 0x0506,
                              .counts = {1, -2, 300},
                              .gimbal = {0, 0, 0},
                              .pressed = {true, false},
                              .docked = true});
  REQUIRE(frame.size() == 64);
  CHECK(Bytes(frame.begin(), frame.begin() + 16) ==
        Bytes{'L', 'O', 1, 'S', 4, 3, 2, 1, 0x14, 0x13, 0x12, 0x11, 3, 0, 6, 5});
  CHECK(Bytes(frame.begin() + 16, frame.begin() + 26) == Bytes{0, 0, 0x1e, 0, 1, 0, 0xfe, 0xff, 0x2c, 0x01});
  for (std::size_t i = 0; i < 6; i += 2) {  // r = 1/2 in the middle: A = B
    CHECK(frame[26 + i] == frame[38 + i]);
    CHECK(frame[27 + i] == frame[39 + i]);
  }
  CHECK(frame[16 + 19] == 0b010);  // the first button pressed, the second not, docked
  std::uint32_t crc = 0;
  for (std::size_t i = 64; i-- > 60;) crc = crc << 8U | frame[i];
  CHECK(crc32(std::span(frame).first(60)) == crc);
}

TEST_CASE("a command is decoded, and any wrong byte makes it invalid") {
  const Bytes right = command(7, {0x123, 0x456, 0x789}, true, 20);
  const auto decoded = decode(right);
  REQUIRE(decoded);
  CHECK(decoded->sequence == 7);
  CHECK(decoded->watchdog == 20);
  CHECK(decoded->dac == std::array<std::uint16_t, 3>{0x123, 0x456, 0x789});
  CHECK(decoded->motors_on());
  for (std::size_t i = 0; i < right.size(); ++i) {
    Bytes wrong = right;
    wrong[i] ^= 1U;
    CHECK_FALSE(decode(wrong));
  }
  CHECK_FALSE(decode(std::span(right).first(31)));
  CHECK_FALSE(decode(command(7, {}, true, 0)));
  CHECK_FALSE(decode(command(7, {}, true, 1001)));
}

TEST_CASE("the board's motors have torque from the first command to the watchdog's trip") {
  OmniBoard board;
  CHECK_FALSE(board.motors_on());
  CHECK(board.flags() == 0);
  CHECK(board.take(milliseconds(1), command(1, {100, 200, 300}, true, 20)));
  CHECK(board.motors_on());
  CHECK(board.dac() == OmniBoard::Dac{100, 200, 300});
  CHECK_FALSE(board.watch(milliseconds(20)));
  CHECK(board.watch(milliseconds(21)));
  CHECK_FALSE(board.motors_on());
  CHECK(board.dac() == OmniBoard::Dac{0x7ff, 0x7ff, 0x7ff});
  CHECK(board.flags() == 3);
}

TEST_CASE("after a trip the board wants a command with motors off before one with motors on") {
  OmniBoard board;
  CHECK(board.take(milliseconds(1), command(1, {}, true, 20)));
  CHECK(board.watch(milliseconds(50)));
  CHECK(board.take(milliseconds(51), command(2, {}, true, 20)));
  CHECK_FALSE(board.motors_on());
  CHECK(board.flags() == 2);
  CHECK(board.take(milliseconds(52), command(3, {}, false, 20)));
  CHECK(board.flags() == 0);
  CHECK(board.take(milliseconds(53), command(4, {}, true, 20)));
  CHECK(board.motors_on());
}

TEST_CASE("the board ignores a command that is not newer, until a second has gone by") {
  OmniBoard board;
  CHECK(board.take(milliseconds(1), command(0xffffffff, {1, 1, 1}, true, 1000)));
  CHECK(board.take(milliseconds(2), command(0, {2, 2, 2}, true, 1000)));  // newer, around the end of 32 bits
  CHECK_FALSE(board.take(milliseconds(3), command(0, {3, 3, 3}, true, 1000)));
  CHECK_FALSE(board.take(milliseconds(3), command(0xffffffff, {3, 3, 3}, true, 1000)));
  CHECK(board.dac() == OmniBoard::Dac{2, 2, 2});
  CHECK(board.take(milliseconds(1002), command(0xfffffff0, {4, 4, 4}, true, 1000)));
}
