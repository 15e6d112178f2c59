// SPDX-License-Identifier: MIT
// The adapter of the Omni against a live emulated one, behind the real libusb.
#include <limpid/device/usb/usb_omni.hpp>

#include "conformance/haptic_device_suite.hpp"
#include "support/no_allocation.hpp"
#include "usb/usb_bench.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

using limpid::SafeTorque, limpid::Status, limpid::UsbCount, limpid::UsbFault, limpid::UsbOmni;
using limpid::emulator::OmniFault;
using limpid::test::UsbBench, limpid::test::comes;
using namespace std::chrono_literals;
using Vector = Eigen::Vector3d;

TEST_CASE("a UsbOmni keeps the laws of a HapticDevice") {
  UsbBench bench;
  UsbOmni omni(bench.settings());
  REQUIRE(bench.start(omni));
  // A state or more comes with each pass, and none between two: the suite reads twice and compares.
  bench.omni.set(OmniFault::silence);
  const auto pass = [&](limpid::Time now) {
    while (limpid::steady_now() < now) std::this_thread::sleep_for(100us);
    if (!bench.omni.snapshot().plugged) return;
    const auto states = omni.counters()[UsbCount::states];
    bench.omni.clear(OmniFault::silence);
    REQUIRE(comes([&] { return omni.counters()[UsbCount::states] > states; }));
    bench.omni.set(OmniFault::silence);
    const auto last = bench.omni.snapshot().last_frame;
    REQUIRE(comes([&] {
      (void)omni.read(now);
      return omni.state().sequence == last;
    }));
  };
  const auto unplug = [&] {
    bench.omni.unplug();
    REQUIRE(comes([&] { return omni.counters()[UsbCount::disconnects] > 0; }));
  };
  limpid::test::check_haptic_device(omni, pass, unplug, limpid::steady_now());
}

TEST_CASE("an Omni that was docked and drawn out gives its angles") {
  auto emulated = UsbBench::docked_at_start();
  emulated.docked = false;
  UsbBench bench(emulated);
  UsbOmni omni(bench.settings());
  CHECK(limpid::has(omni.read(limpid::steady_now()).status, Status::no_sample));
  REQUIRE(bench.start(omni));
  const auto seen = omni.read(limpid::steady_now());
  CHECK(!limpid::has(seen.status, Status::no_sample | Status::fault | Status::disconnected));
  // an encoder step of 4.2e-4 rad, of one count to either side
  CHECK((seen.q - bench.omni.snapshot().joints.q).cwiseAbs().maxCoeff() < 9e-4);
}

TEST_CASE("motors are off until it was docked, and as long as it is docked") {
  auto emulated = UsbBench::docked_at_start();
  emulated.docked = false;
  UsbBench bench(emulated);
  UsbOmni omni(bench.settings());
  const Vector wanted(0.05, 0.05, 0.02);
  CHECK(bench.loop(omni, wanted, [&](const auto&) { return bench.omni.snapshot().commands > 50; }));
  CHECK(bench.omni.snapshot().largest_torque.isZero(0));
  bench.omni.set_docked(true);
  const auto before = bench.omni.snapshot().commands;
  CHECK(bench.loop(omni, wanted, [&](const auto&) { return bench.omni.snapshot().commands > before + 50; }));
  CHECK(omni.calibrated());
  CHECK(bench.omni.snapshot().largest_torque.isZero(0));
  bench.omni.set_docked(false);
  CHECK(bench.loop(omni, wanted, [&](const auto&) { return bench.omni.snapshot().motors_on; }));
}

TEST_CASE("the motors give the torque that was written, to a step of their converters") {
  UsbBench bench;
  UsbOmni omni(bench.settings());
  const Vector wanted(0.05, 0.06, -0.03);
  REQUIRE(bench.start(omni, wanted));
  // an arm that moves freely comes to its limits: the torque is looked at on the way
  const Vector step = Vector(1, 1, 1.43) * UsbBench::full_scale * 2 / 4095;
  CHECK(bench.loop(omni, wanted, [&](const auto&) {
    return ((bench.omni.snapshot().torque - wanted).cwiseAbs().array() <= step.array()).all();
  }));
}

TEST_CASE("the torque rises from zero over the ramp") {
  UsbBench bench;
  auto settings = bench.settings();
  settings.ramp = 2s;
  UsbOmni omni(settings);
  REQUIRE(bench.start(omni, {0, 0.1, 0}));
  const auto began = limpid::steady_now();
  bool below = true;
  CHECK(bench.loop(omni, {0, 0.1, 0}, [&](const auto&) {
    const double risen = std::chrono::duration<double>(limpid::steady_now() - began + 300ms).count() / 2;  // it began
    below = below && bench.omni.snapshot().torque[1] <= 0.1 * risen + 0.3 * 2 / 4095;  // before it was seen to
    return bench.omni.snapshot().torque[1] > 0.03;
  }));
  CHECK(below);
}

TEST_CASE("the motors are off when a UsbOmni ends, in whatever way") {
  UsbBench bench;
  const Vector wanted(0.05, 0.05, 0.02);
  SUBCASE("by its destructor") {
    UsbOmni omni(bench.settings());
    REQUIRE(bench.start(omni, wanted));
  }
  SUBCASE("by an exception") {
    try {
      UsbOmni omni(bench.settings());
      REQUIRE(bench.start(omni, wanted));
      throw std::runtime_error("in the loop");
    } catch (const std::runtime_error&) {
    }
  }
  const auto after = bench.omni.snapshot();
  CHECK(!after.motors_on);
  CHECK(after.last_dac == limpid::OmniBridge::safe().converter);
  CHECK(after.watchdog_trips_with_torque == 0);  // it was told so, and did not have to find out
}

TEST_CASE("the motors are off when a UsbOmni ends whose endpoints are halted") {
  UsbBench bench;
  auto settings = bench.settings();
  settings.link.device_watchdog = 1s;
  {
    UsbOmni omni(settings);
    REQUIRE(bench.start(omni, Vector(0.05, 0.05, 0.02)));
    bench.omni.set(OmniFault::stall_in);
    bench.omni.set(OmniFault::stall_out);
  }
  const auto after = bench.omni.snapshot();
  CHECK(!after.motors_on);
  CHECK(after.watchdog_trips_with_torque == 0);
}

TEST_CASE("numbers and a clock that wrap are borne") {
  auto emulated = UsbBench::docked_at_start();
  emulated.sequence = 0xFFFF'FFFFU - 700;  // it wraps after 0.7 s
  emulated.uptime = std::chrono::microseconds(0x1'0000'0000 - 900'000);
  UsbBench bench(emulated);
  UsbOmni omni(bench.settings());
  const Vector wanted(0.03, 0.05, 0.02);
  REQUIRE(bench.start(omni, wanted));
  CHECK(bench.loop(omni, wanted, [&](const auto&) {
    const auto& state = omni.state();
    return state.sequence > 400 && state.sequence < 1U << 31U && state.device_time < 1U << 31U;
  }));
  CHECK(omni.fault() == UsbFault::none);
  CHECK(bench.omni.snapshot().motors_on);
}

TEST_CASE("a loop that gives no command has its motors taken off, until that is cleared") {
  UsbBench bench;
  auto settings = bench.settings();
  settings.link.device_watchdog = 1s;
  settings.link.host_watchdog = 200ms;  // the first, whatever else the machine does
  UsbOmni omni(settings);
  const Vector wanted(0.05, 0.05, 0.02);
  REQUIRE(bench.start(omni, wanted));
  CHECK(comes([&] { return !bench.omni.snapshot().motors_on; }));
  CHECK(bench.omni.snapshot().watchdog_trips_with_torque == 0);  // the host's was the first
  CHECK(bench.loop(omni, wanted, [&](const auto& seen) { return limpid::has(seen.status, Status::fault); }));
  CHECK(omni.fault() == UsbFault::loop_silent);
  const auto commands = bench.omni.snapshot().commands;
  CHECK(bench.loop(omni, wanted, [&](const auto&) { return bench.omni.snapshot().commands > commands + 50; }));
  CHECK(!bench.omni.snapshot().motors_on);
  omni.clear_fault();
  CHECK(bench.loop(omni, wanted, [&](const auto&) { return bench.omni.snapshot().motors_on; }));
  CHECK(omni.fault() == UsbFault::none);
}

TEST_CASE("a device that was unplugged is opened again, and has torque only once it was docked and the fault cleared") {
  UsbBench bench;
  UsbOmni omni(bench.settings());
  const Vector wanted(0.05, 0.05, 0.02);
  REQUIRE(bench.start(omni, wanted));
  bench.omni.unplug();
  CHECK(bench.loop(omni, wanted, [&](const auto& seen) { return limpid::has(seen.status, Status::disconnected); }));
  CHECK(omni.fault() == UsbFault::disconnected);
  SUBCASE("at the same port") { bench.omni.plug(); }
  SUBCASE("at another port") { bench.omni.plug("1-3"); }
  const auto states = omni.counters()[UsbCount::states];
  CHECK(bench.loop(omni, wanted, [&](const auto&) { return omni.counters()[UsbCount::states] > states + 50; }));
  bench.omni.mark();
  omni.clear_fault();
  const auto commands = bench.omni.snapshot().commands;
  CHECK(bench.loop(omni, wanted, [&](const auto&) { return bench.omni.snapshot().commands > commands + 50; }));
  CHECK(omni.fault() == UsbFault::none);
  CHECK(bench.omni.snapshot().largest_torque.isZero(0));
  CHECK(bench.start(omni, wanted));
}

TEST_CASE("reading and writing allocate nothing") {
  UsbBench bench;
  UsbOmni omni(bench.settings());
  REQUIRE(bench.start(omni));
  limpid::test::check_no_allocation([&] {
    (void)omni.read(limpid::steady_now());
    (void)omni.write(SafeTorque<3>{});
    omni.clear_fault();
  });
}

TEST_CASE("settings that cannot serve are refused by their name") {
  const auto refused = [](auto&& change, const char* field) {
    UsbOmni::Settings settings{.calibration = {.full_scale = Vector::Ones()}};
    change(settings);
    CAPTURE(field);
    CHECK_THROWS_WITH_AS(UsbOmni{settings}, doctest::Contains(field), std::invalid_argument);
  };
  refused([](auto& s) { s.calibration.full_scale[0] = -1; }, "OmniCalibration: full_scale");
  refused([](auto& s) { s.ramp = -1ms; }, "UsbOmni: ramp");
  refused([](auto& s) { s.fastest = 0; }, "UsbOmni: fastest");
  refused([](auto& s) { s.rate_filter = 0; }, "time_constant");
  refused([](auto& s) { s.link.device_watchdog = 0ms; }, "UsbLink: device_watchdog");
  refused([](auto& s) { s.link.host_watchdog = 1h; }, "UsbLink: host_watchdog");
  refused([](auto& s) { s.link.stale_after = 1ms; }, "UsbLink: stale_after");
  refused([](auto& s) { s.link.poll = 1s; }, "UsbLink: poll");
  refused([](auto& s) { s.link.search_every = 0s; }, "UsbLink: search_every");
}
