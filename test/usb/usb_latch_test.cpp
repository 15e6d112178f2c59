// SPDX-License-Identifier: MIT
// What clearing a fault ends and what it does not, and when the angles are doubtful.
#include <limpid/device/usb/usb_omni.hpp>

#include "usb/usb_bench.hpp"

#include <doctest/doctest.h>

#include <optional>

using limpid::OmniBridge, limpid::Status, limpid::UsbCount, limpid::UsbFault, limpid::UsbOmni;
using limpid::emulator::EmulatedOmni, limpid::emulator::OmniFault;
using limpid::test::UsbBench, limpid::test::comes;
using namespace std::chrono_literals;
using Vector = Eigen::Vector3d;
using Link = limpid::UsbLink<OmniBridge>;

namespace {

const Vector wanted(0.03, 0.05, 0.02);  // N m

bool loops_until_fault(UsbBench& bench, UsbOmni& omni, UsbFault fault) {
  return bench.loop(omni, wanted, [&](const auto&) { return omni.fault() == fault; });
}

// So many more states have come; `each` in every tick.
template <typename Each>
bool loops_on(UsbBench& bench, UsbOmni& omni, int states, Each&& each) {
  const auto from = omni.counters()[UsbCount::states];
  return bench.loop(omni, wanted, [&](const auto& seen) {
    each(seen);
    return omni.counters()[UsbCount::states] > from + static_cast<std::uint64_t>(states);
  });
}

bool loops_on(UsbBench& bench, UsbOmni& omni, int states) {
  return loops_on(bench, omni, states, [](const auto&) {});
}

// The fault can be cleared, and yet there is no torque before it was docked.
void check_wants_dock(UsbBench& bench, UsbOmni& omni, const EmulatedOmni& device) {
  CHECK(loops_on(bench, omni, 50, [&](const auto&) { omni.clear_fault(); }));
  CHECK(omni.fault() == UsbFault::none);
  CHECK(!omni.calibrated());
  CHECK(!device.snapshot().motors_on);
}

}  // namespace

TEST_CASE("a device that was without power while it was stale must be docked again") {
  UsbBench bench;
  UsbOmni omni(bench.settings());
  REQUIRE(bench.start(omni, wanted));
  bench.omni.set(OmniFault::silence);
  REQUIRE(loops_until_fault(bench, omni, UsbFault::stale));
  bench.omni.reboot();
  bench.omni.clear_faults();
  CHECK(loops_until_fault(bench, omni, UsbFault::power_cycled));
  check_wants_dock(bench, omni, bench.omni);
  CHECK(bench.start(omni, wanted));
}

TEST_CASE("a device that does not count its power-ups is known by its numbers, which begin anew") {
  UsbBench bench;
  UsbOmni omni(bench.settings());
  REQUIRE(bench.start(omni, wanted));
  bench.omni.reboot(false);
  CHECK(loops_until_fault(bench, omni, UsbFault::power_cycled));
  check_wants_dock(bench, omni, bench.omni);
  CHECK(bench.start(omni, wanted));
}

TEST_CASE("another device in place of one that was stale must be docked, though it counts its power-ups alike") {
  UsbBench bench;
  UsbOmni omni(bench.settings());
  REQUIRE(bench.start(omni, wanted));
  bench.omni.set(OmniFault::silence);
  REQUIRE(loops_until_fault(bench, omni, UsbFault::stale));
  bench.omni.unplug();
  auto settings = UsbBench::docked_at_start();
  settings.docked = false;
  settings.path = "1-2";
  EmulatedOmni other(bench.bus, settings);
  CHECK(loops_until_fault(bench, omni, UsbFault::disconnected));
  CHECK(loops_on(bench, omni, 20));
  check_wants_dock(bench, omni, other);
}

TEST_CASE("a watchdog of the device that tripped between two readings is stated") {
  UsbBench bench;
  auto settings = bench.settings();
  settings.link.device_watchdog = 100ms;
  UsbOmni omni(settings);
  REQUIRE(bench.start(omni, wanted));
  const auto writes_until = [&](auto&& done) {
    return comes([&] {
      (void)omni.write(bench.torque(limpid::steady_now(), {}, wanted));
      return done();
    });
  };
  const auto trips = bench.omni.snapshot().watchdog_trips;
  bench.omni.set(OmniFault::protocol_error_out);
  REQUIRE(writes_until([&] { return bench.omni.snapshot().watchdog_trips > trips; }));
  bench.omni.clear_faults();
  const auto commands = bench.omni.snapshot().commands;
  REQUIRE(writes_until([&] { return bench.omni.snapshot().commands > commands + 5; }));
  const auto states = omni.counters()[UsbCount::states];
  REQUIRE(writes_until([&] { return omni.counters()[UsbCount::states] > states + 5; }));
  CHECK(loops_until_fault(bench, omni, UsbFault::watchdog_off));
  CHECK(!bench.omni.snapshot().motors_on);
  CHECK(bench.clear_and_start(omni, wanted));
}

TEST_CASE("clearing in every tick takes no torque away, and ends a fault once its cause has gone") {
  UsbBench bench;
  auto settings = bench.settings();
  settings.link.device_watchdog = 100ms;
  UsbOmni omni(settings);
  REQUIRE(bench.start(omni, wanted));
  const auto trips = bench.omni.snapshot().watchdog_trips;
  CHECK(loops_on(bench, omni, 300, [&](const auto&) { omni.clear_fault(); }));
  if (bench.omni.snapshot().watchdog_trips == trips) CHECK(!bench.omni.snapshot().motors_until);
  bench.omni.set(OmniFault::out_stuck);
  CHECK(bench.loop(omni, wanted, [&](const auto&) {
    omni.clear_fault();
    return bench.omni.snapshot().watchdog_trips > trips;
  }));
  bench.omni.clear_faults();
  CHECK(bench.loop(omni, wanted, [&](const auto&) {
    omni.clear_fault();
    return bench.omni.snapshot().motors_on;
  }));
}

TEST_CASE("a fault that was latched after the last reading is not cleared unseen") {
  UsbBench bench;
  Link link(bench.settings().link);
  (void)link.read(limpid::steady_now());
  (void)link.write(OmniBridge::safe());
  REQUIRE(comes([&] { return link.fault() == UsbFault::loop_silent; }));
  link.clear();
  const auto commands = bench.omni.snapshot().commands;
  REQUIRE(comes([&] {
    (void)link.write(OmniBridge::safe());
    return bench.omni.snapshot().commands > commands + 20;
  }));
  CHECK(link.fault() == UsbFault::loop_silent);
  CHECK(link.read(limpid::steady_now()).fault == UsbFault::loop_silent);
  link.clear();
  CHECK(link.read(limpid::steady_now()).fault == UsbFault::none);
  CHECK(comes([&] {
    (void)link.write(OmniBridge::safe());
    return link.fault() == UsbFault::none;
  }));
}

TEST_CASE("a device that repeats itself stays stale") {
  UsbBench bench;
  auto settings = bench.settings();
  settings.link.stale_after = 200ms;
  UsbOmni omni(settings);
  REQUIRE(bench.start(omni, wanted));
  bench.omni.set(OmniFault::stuck);
  const auto& counters = omni.counters();
  const auto repeats = [&](std::uint64_t until) {
    return bench.loop(omni, wanted, [&](const auto&) { return counters[UsbCount::repeated] >= until; });
  };
  REQUIRE(repeats(counters[UsbCount::repeated] + 10));  // what was on its way has come
  const auto states = counters[UsbCount::states];
  CHECK(repeats(counters[UsbCount::repeated] + 1000));
  CHECK(counters[UsbCount::states] == states);
  CHECK(omni.fault() == UsbFault::stale);
}

TEST_CASE("a controller that takes no command any more leaves the device silent") {
  UsbBench bench;
  auto settings = bench.settings();
  settings.link.device_watchdog = 1s;
  settings.link.host_watchdog = 200ms;
  UsbOmni omni(settings);
  REQUIRE(bench.start(omni, wanted));
  bench.omni.set(OmniFault::out_refused);
  CHECK(bench.loop(omni, wanted, [&](const auto& seen) { return limpid::has(seen.status, Status::fault); }));
  CHECK(omni.fault() == UsbFault::device_silent);
  bench.omni.clear_faults();
  CHECK(bench.clear_and_start(omni, wanted));
}

TEST_CASE("where time goes backwards no torque turns round, and no stamp goes back") {
  UsbBench bench;
  auto settings = bench.settings();
  settings.ramp = 10s;
  UsbOmni omni(settings);
  REQUIRE(bench.start(omni, wanted));
  const auto before = omni.read(limpid::steady_now()).stamp;
  const Vector pull(0, 0.1, 0);
  const double step = UsbBench::full_scale * 2 / 4095;  // of a converter
  for (int i = 0; i < 30; ++i) {
    const auto seen = omni.read(limpid::steady_now() - 1h);
    CHECK(seen.stamp >= before);
    if (bench.limiter.reason() != limpid::FaultReason::none) bench.limiter.reset(limpid::steady_now());
    (void)omni.write(bench.torque(limpid::steady_now(), seen, pull));
    CHECK(bench.omni.snapshot().torque[1] >= -step);
    std::this_thread::sleep_for(1ms);
  }
}

TEST_CASE("a UsbOmni whose device went away ends without searching to the end") {
  UsbBench bench;
  auto settings = bench.settings();
  settings.link.search_every = 10s;
  std::optional<UsbOmni> omni(settings);
  bench.omni.unplug();
  REQUIRE(comes([&] { return omni->counters()[UsbCount::disconnects] > 0; }));
  const auto before = limpid::steady_now();
  omni.reset();
  CHECK(limpid::steady_now() - before < 9s);  // of the 10 s that it searches for
}
