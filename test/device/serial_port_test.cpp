// SPDX-License-Identifier: MIT
#include <limpid/device/serial/serial_port.hpp>

#include <support/serial_line.hpp>

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <span>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

using limpid::BytePort;
using limpid::Duration;
using limpid::PortRead;
using limpid::SerialPort;
using limpid::test::SerialLine;
using namespace std::chrono_literals;

namespace {

using Bytes = std::vector<std::uint8_t>;

struct Wrong {  // each is one call short of a port
  bool open() noexcept { return true; }
  PortRead read(std::span<std::uint8_t>, Duration) noexcept { return {}; }
  void close() noexcept {}
};
struct Throws : Wrong {
  bool write(std::span<const std::uint8_t>) { return true; }
};
struct TellsNothing : Wrong {
  void write(std::span<const std::uint8_t>) noexcept {}
};

static_assert(BytePort<SerialPort>);
static_assert(!BytePort<int>);
static_assert(!BytePort<Wrong>);
static_assert(!BytePort<Throws>);
static_assert(!BytePort<TellsNothing>);

// Reads until `count` bytes have come or the line is no more.
Bytes read_all(SerialPort& port, std::size_t count) {
  Bytes all;
  std::array<std::uint8_t, 64> piece{};
  for (int k = 0; k < 3000 && all.size() < count; ++k) {
    const PortRead got = port.read(piece, 10ms);
    if (!got.open) break;
    all.insert(all.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(got.bytes));
  }
  return all;
}

Bytes receive_all(SerialLine& terminal, std::size_t count) {
  Bytes all;
  for (int k = 0; k < 3000 && all.size() < count; ++k) {
    const Bytes more = terminal.receive();
    all.insert(all.end(), more.begin(), more.end());
    if (more.empty()) std::this_thread::sleep_for(10ms);
  }
  return all;
}

Bytes every_byte() {
  Bytes bytes;
  for (int k = 0; k < 256; ++k) bytes.push_back(static_cast<std::uint8_t>(k));
  return bytes;
}

}  // namespace

TEST_CASE("every byte passes both ways as it is") {
  SerialLine terminal;
  SerialPort port({.device = terminal.path()});
  REQUIRE(port.open());
  terminal.send(every_byte());
  CHECK(read_all(port, 256) == every_byte());
  CHECK(port.write(every_byte()));
  CHECK(receive_all(terminal, 256) == every_byte());
}

TEST_CASE("where nothing comes, nothing is read, and the port stays open") {
  SerialLine terminal;
  SerialPort port({.device = terminal.path()});
  REQUIRE(port.open());
  std::array<std::uint8_t, 16> bytes{};
  for (int k = 0; k < 3; ++k) {
    const PortRead got = port.read(bytes, 1ms);
    CHECK(got.bytes == 0);
    CHECK(got.open);
  }
  terminal.send({1, 2, 3});
  CHECK(read_all(port, 3) == Bytes{1, 2, 3});
}

TEST_CASE("what waited before the port was opened is dropped") {
  SerialLine terminal;
  terminal.send({1, 2, 3});
  SerialPort port({.device = terminal.path()});
  REQUIRE(port.open());
  terminal.send({4});
  CHECK(read_all(port, 1) == Bytes{4});
}

TEST_CASE("when the other side goes away the port says so, and opens again when it is back") {
  SerialLine terminal;
  SerialPort port({.device = terminal.path()});
  REQUIRE(port.open());
  terminal.unplug();
  std::array<std::uint8_t, 16> bytes{};
  CHECK(!port.read(bytes, 1s).open);
  CHECK(!port.write(bytes));
  CHECK(!port.open());
  CHECK(!port.read(bytes, 1ms).open);
  terminal.plug_in();
  REQUIRE(port.open());
  terminal.send({7});
  CHECK(read_all(port, 1) == Bytes{7});
}

TEST_CASE("a write that nobody takes ends") {
  SerialLine terminal;
  SerialPort port({.device = terminal.path(), .longest_write = 20ms});
  REQUIRE(port.open());
  CHECK(!port.write(Bytes(1'000'000)));
}

TEST_CASE("what is closed, is no terminal or does not exist is not open") {
  SerialLine terminal;
  SerialPort port({.device = terminal.path()}), null({.device = "/dev/null"}), none({.device = "/dev/no/such"});
  std::array<std::uint8_t, 16> bytes{};
  CHECK(!port.read(bytes, 1ms).open);
  CHECK(!null.open());
  CHECK(!none.open());
  CHECK(!none.write(bytes));
  REQUIRE(port.open());
  port.close();
  CHECK(!port.write(bytes));
}

TEST_CASE("a port that is moved stays open") {
  SerialLine terminal;
  SerialPort port({.device = terminal.path()});
  REQUIRE(port.open());
  SerialPort moved(std::move(port));
  terminal.send({9});
  CHECK(read_all(moved, 1) == Bytes{9});
}

TEST_CASE("settings that cannot serve are refused by name") {
  CHECK_THROWS_WITH_AS(SerialPort({.device = ""}), "SerialPort: device: expected a path, got an empty one",
                       std::invalid_argument);
  CHECK_THROWS_AS(SerialPort({.device = "/dev/ttyACM0", .baud = 0}), std::invalid_argument);
  CHECK_THROWS_AS(SerialPort({.device = "/dev/ttyACM0", .longest_write = 0ms}), std::invalid_argument);
}
