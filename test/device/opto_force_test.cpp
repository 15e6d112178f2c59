// SPDX-License-Identifier: MIT
// The sensor's driver against an emulator that lives behind a pseudo-terminal. Nothing here asks for a time to be
// short: each test waits for what must come about, for as long as half a minute.
#include <limpid/device/serial/opto_force.hpp>
#include <limpid/device/serial/serial_port.hpp>

#include <conformance/force_sensor_suite.hpp>
#include <support/no_allocation.hpp>
#include <support/opto_force_emulator.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <span>
#include <stdexcept>
#include <thread>

using limpid::BytePort;
using limpid::Duration;
using limpid::ForceReading;
using limpid::ForceSensor;
using limpid::OptoForce;
using limpid::OptoForceLink;
using limpid::PortRead;
using limpid::SerialPort;
using limpid::Status;
using limpid::steady_now;
using limpid::Time;
using limpid::test::Bytes;
using limpid::test::frame_bytes;
using limpid::test::OptoForceEmulator;
using namespace std::chrono_literals;

static_assert(ForceSensor<OptoForce<SerialPort>>);

namespace {

using Sensor = OptoForce<SerialPort>;

// 100, 50 and 10 counts a newton. A frame may be late on a loaded machine: only `stale` after a second.
Sensor::Settings settings() {
  Sensor::Settings settings;
  settings.calibration.newtons_per_count = Eigen::Vector3d(0.01, 0.02, 0.1).asDiagonal();
  settings.longest_age = 1s;
  settings.silence = 20s;
  settings.answer = 5s;
  settings.retry = 20ms;
  return settings;
}

// Reads until `holds(reading)`.
template <typename S, typename Holds>
ForceReading<> wait_for(S& sensor, Holds&& holds) {
  const Time until = steady_now() + 30s;
  ForceReading<> reading = sensor.read(steady_now());
  while (!holds(reading) && steady_now() < until) {
    std::this_thread::sleep_for(1ms);
    reading = sensor.read(steady_now());
  }
  CHECK(holds(reading));
  return reading;
}

constexpr auto is_well = [](const ForceReading<>& reading) { return reading.status == Status::ok; };

// Whole frames, until so many more have come.
void wait_for_frames(Sensor& sensor, std::uint64_t more) {
  const std::uint64_t before = sensor.report().counters.bytes.frames;
  (void)wait_for(sensor, [&](const auto&) { return sensor.report().counters.bytes.frames >= before + more; });
}

}  // namespace

TEST_CASE("the sensor is configured as it was asked to be, and its counts become newtons") {
  OptoForceEmulator emulator;
  emulator.feel({250, -100, 5});
  Sensor::Settings wanted = settings();
  wanted.configuration = {.period = 3ms, .filter = limpid::OptoForceFilter::hz_50, .zero = true};
  Sensor sensor(SerialPort({.device = emulator.path()}), wanted);
  const auto reading = wait_for(sensor, is_well);
  CHECK((reading.force - Eigen::Vector3d(2.5, -2, 0.5)).norm() < 1e-15);
  CHECK(sensor.report().link == OptoForceLink::connected);
  REQUIRE(!emulator.configurations().empty());
  CHECK(emulator.configurations().back() == Bytes{0xAA, 0, 0x32, 3, 3, 3, 255, 1, 228});  // 223 + 3 + 3 + 255 = 484
}

TEST_CASE("it is a force sensor") {
  OptoForceEmulator emulator;
  Sensor::Settings quick = settings();
  quick.longest_age = 100ms;
  Sensor sensor(SerialPort({.device = emulator.path()}), quick);
  limpid::test::check_force_sensor(
      sensor,
      [] {
        std::this_thread::sleep_for(1ms);
        return steady_now();
      },
      [&] {
        emulator.stall(true);
        std::this_thread::sleep_for(50ms);
      },
      [&] { emulator.unplug(); });
}

TEST_CASE("the force follows, and its stamps go on") {
  OptoForceEmulator emulator;
  Sensor sensor(SerialPort({.device = emulator.path()}), settings());
  Time last = wait_for(sensor, is_well).stamp;
  for (int k = 1; k <= 20; ++k) {
    emulator.feel({k * 100, 0, 0});
    const auto reading = wait_for(sensor, [&](const auto& r) { return r.force[0] == k * 100 * 0.01; });
    CHECK(reading.stamp > last);
    last = reading.stamp;
  }
  CHECK(sensor.report().counters.bytes.lost == 0);
  CHECK(sensor.report().counters.bytes.bad_checksums == 0);
}

TEST_CASE("a frame with a wrong checksum is counted and not used") {
  OptoForceEmulator emulator;
  emulator.feel({1, 2, 3});
  Sensor sensor(SerialPort({.device = emulator.path()}), settings());
  (void)wait_for(sensor, is_well);
  emulator.corrupt(5);
  (void)wait_for(sensor, [&](const auto& reading) {
    CHECK(reading.force[2] == 3 * 0.1);  // never the corrupt one
    return sensor.report().counters.bytes.bad_checksums >= 5 && sensor.report().counters.bytes.lost >= 5;
  });
  wait_for_frames(sensor, 5);
  CHECK(sensor.report().counters.bytes.bad_checksums == 5);
  CHECK(sensor.report().counters.bytes.lost == 5);
}

TEST_CASE("lost frames are counted, and garbage between frames passes") {
  OptoForceEmulator emulator;
  Sensor sensor(SerialPort({.device = emulator.path()}), settings());
  (void)wait_for(sensor, is_well);
  emulator.lose(7);
  (void)wait_for(sensor, [&](const auto&) { return sensor.report().counters.bytes.lost > 0; });
  CHECK(sensor.report().counters.bytes.lost == 7);
  const std::uint64_t skipped = sensor.report().counters.bytes.skipped;
  emulator.send({1, 2, 0xAA, 0xAA, 7, 8, 9});
  (void)wait_for(sensor, [&](const auto&) { return sensor.report().counters.bytes.skipped > skipped; });
  wait_for_frames(sensor, 5);
  CHECK(sensor.report().counters.bytes.skipped == skipped + 7);
  CHECK(sensor.report().counters.bytes.lost == 7);
  CHECK(is_well(wait_for(sensor, is_well)));
}

TEST_CASE("an error of the sensor is a fault, and the force before it is kept") {
  OptoForceEmulator emulator;
  emulator.feel({100, 0, 0});
  Sensor sensor(SerialPort({.device = emulator.path()}), settings());
  (void)wait_for(sensor, is_well);
  emulator.say(0x0400);
  emulator.feel({-9999, 0, 0});  // what it then gives is not to be trusted
  (void)wait_for(sensor, [](const auto& reading) { return has(reading.status, Status::fault); });
  wait_for_frames(sensor, 5);
  const auto faulty = sensor.read(steady_now());
  CHECK(has(faulty.status, Status::fault));
  CHECK(faulty.force[0] == 1);
  CHECK(sensor.report().status == 0x0400);
  CHECK(sensor.report().counters.errors >= 5);
  emulator.say(0);
  CHECK(wait_for(sensor, is_well).force[0] == -9999 * 0.01);
}

TEST_CASE("an overload is said, with the force") {
  OptoForceEmulator emulator;
  Sensor sensor(SerialPort({.device = emulator.path()}), settings());
  (void)wait_for(sensor, is_well);
  emulator.feel({30000, 0, 0});
  emulator.say(0x0002);
  const auto reading =
      wait_for(sensor, [](const auto& r) { return has(r.status, Status::overload) && r.force[0] == 300; });
  CHECK(reading.status == Status::overload);
  CHECK(sensor.report().counters.overloads > 0);
  emulator.say(0);
  (void)wait_for(sensor, is_well);
}

TEST_CASE("a sensor that stalls is stale, then silent, and is well when it goes on") {
  OptoForceEmulator emulator;
  emulator.feel({100, 0, 0});
  Sensor::Settings quick = settings();
  quick.longest_age = 100ms;
  quick.silence = 500ms;
  Sensor sensor(SerialPort({.device = emulator.path()}), quick);
  (void)wait_for(sensor, is_well);
  emulator.stall(true);
  const auto stale = wait_for(sensor, [](const auto& reading) { return has(reading.status, Status::stale); });
  CHECK(stale.force[0] == 1);
  (void)wait_for(sensor, [&](const auto&) { return sensor.report().counters.connections >= 2; });  // opened anew
  emulator.feel({200, 0, 0});
  emulator.stall(false);
  CHECK(wait_for(sensor, is_well).force[0] == 2);
}

TEST_CASE("unplugged the sensor is disconnected with its last force, plugged in again it is configured and well") {
  OptoForceEmulator emulator;
  emulator.feel({100, 0, 0});
  Sensor sensor(SerialPort({.device = emulator.path()}), settings());
  (void)wait_for(sensor, is_well);
  for (int k = 2; k <= 4; ++k) {
    emulator.unplug();
    const auto gone = wait_for(sensor, [](const auto& reading) { return has(reading.status, Status::disconnected); });
    CHECK(gone.force[0] == (k - 1) * 100 * 0.01);
    emulator.feel({k * 100, 0, 0});
    const auto times = emulator.configurations().size();
    emulator.plug_in();
    CHECK(wait_for(sensor, is_well).force[0] == k * 100 * 0.01);
    CHECK(emulator.configurations().size() > times);
    CHECK(sensor.report().counters.connections == static_cast<std::uint64_t>(k));
  }
}

TEST_CASE("a sensor that does not answer is not used until it does") {
  OptoForceEmulator emulator;
  emulator.answer({});
  Sensor::Settings impatient = settings();
  impatient.answer = 50ms;
  Sensor sensor(SerialPort({.device = emulator.path()}), impatient);
  const auto reading = wait_for(sensor, [&](const auto&) { return sensor.report().link == OptoForceLink::no_answer; });
  CHECK(reading.status == (Status::disconnected | Status::no_sample));  // its frames are of another configuration
  CHECK(sensor.report().counters.bytes.frames > 0);
  CHECK(emulator.configurations().size() >= 3);
  emulator.answer(0);
  (void)wait_for(sensor, is_well);
}

TEST_CASE("a sensor that refuses its configuration is not used until it takes it") {
  OptoForceEmulator emulator;
  emulator.answer(4);
  Sensor sensor(SerialPort({.device = emulator.path()}), settings());
  const auto reading = wait_for(sensor, [&](const auto&) { return sensor.report().link == OptoForceLink::refused; });
  CHECK(reading.status == (Status::disconnected | Status::no_sample));
  emulator.answer(0);
  (void)wait_for(sensor, is_well);
}

TEST_CASE("a device that is not there yet is waited for") {
  OptoForceEmulator emulator;
  emulator.unplug();
  Sensor sensor(SerialPort({.device = emulator.path()}), settings());
  const auto reading =
      wait_for(sensor, [&](const auto&) { return sensor.report().link == OptoForceLink::cannot_open; });
  CHECK(reading.status == (Status::disconnected | Status::no_sample));
  CHECK(reading.force == Eigen::Vector3d(0, 0, 0));
  CHECK(describe(sensor.report().link) == "the port cannot be opened");
  emulator.plug_in();
  (void)wait_for(sensor, is_well);
}

TEST_CASE("it can be taken down in any state") {
  OptoForceEmulator emulator;
  for (int k = 0; k < 20; ++k) {
    const Sensor sensor(SerialPort({.device = emulator.path()}), settings());
    std::this_thread::sleep_for(k * 1ms);
  }
  emulator.answer({});
  for (int k = 0; k < 5; ++k) {
    const Sensor sensor(SerialPort({.device = emulator.path()}), settings());
    std::this_thread::sleep_for(k * 5ms);
  }
}

namespace {

// A port that lives in memory: answers once, then gives a frame a millisecond, and asks for no memory.
class MemoryPort {
 public:
  bool open() noexcept { return true; }
  bool write(std::span<const std::uint8_t>) noexcept { return answers_ = true; }
  void close() noexcept {}
  PortRead read(std::span<std::uint8_t> into, Duration) noexcept {
    std::this_thread::sleep_for(1ms);
    static constexpr std::array<std::uint8_t, 7> answer{0xAA, 0, 0x50, 1, 0, 0, 0xFB};
    // counts 0, 0, 2; sum 195 + 2
    static constexpr std::array<std::uint8_t, 16> frame{0xAA, 7, 8, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0xC5};
    const std::span<const std::uint8_t> next = answers_ ? std::span<const std::uint8_t>(answer) : frame;
    answers_ = false;
    std::copy(next.begin(), next.end(), into.begin());
    return {.bytes = next.size()};
  }

 private:
  bool answers_ = false;
};
static_assert(BytePort<MemoryPort>);

}  // namespace

TEST_CASE("a port of one's own serves, and neither reading nor what feeds it allocates") {
  OptoForce<MemoryPort>::Settings wanted;
  wanted.calibration = settings().calibration;
  wanted.longest_age = 1s;
  wanted.silence = 10s;
  OptoForce<MemoryPort> sensor(MemoryPort{}, wanted);
  CHECK(wait_for(sensor, is_well).force[2] == 0.2);
  const auto before = sensor.report().counters.bytes.frames;
  limpid::test::check_no_allocation([&] {
    for (int k = 0; k < 3000 && sensor.report().counters.bytes.frames < before + 20; ++k) {
      (void)sensor.read(steady_now());
      std::this_thread::sleep_for(1ms);
    }
  });
  CHECK(sensor.report().counters.bytes.frames >= before + 20);
}

TEST_CASE("a reading is not stamped after the time it is asked for") {
  OptoForce<MemoryPort>::Settings wanted;
  wanted.calibration = settings().calibration;
  wanted.longest_age = 1s;
  wanted.silence = 10s;
  const Time early = steady_now();
  OptoForce<MemoryPort> sensor(MemoryPort{}, wanted);
  for (int k = 0; k < 3000; ++k) {
    const auto reading = sensor.read(early);
    if (has(reading.status, Status::no_sample)) {
      std::this_thread::sleep_for(1ms);
      continue;
    }
    CHECK(reading.stamp == early);
    break;
  }
}

TEST_CASE("settings that cannot serve are refused by name, before anything is opened") {
  const auto refused = [](const OptoForce<MemoryPort>::Settings& wrong, const char* field) {
    try {
      const OptoForce<MemoryPort> sensor(MemoryPort{}, wrong);
      FAIL("accepted");
    } catch (const std::invalid_argument& error) {
      CHECK(std::string(error.what()).find(std::string(field) + ": expected") == 0);
    }
  };
  OptoForce<MemoryPort>::Settings good;
  good.calibration = settings().calibration;
  auto wrong = good;
  refused({}, "ForceCalibration: newtons_per_count");
  (wrong = good).configuration.period = 0ms;
  refused(wrong, "OptoForceConfiguration: period");
  (wrong = good).longest_age = 1ms;
  refused(wrong, "OptoForce: longest_age");
  (wrong = good).answer = 0ms;
  refused(wrong, "OptoForce: answer");
  (wrong = good).silence = 20ms;
  refused(wrong, "OptoForce: silence");
  (wrong = good).retry = 0ms;
  refused(wrong, "OptoForce: retry");
}
