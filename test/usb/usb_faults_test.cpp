// SPDX-License-Identifier: MIT
// What can go wrong on the wire: the fault that is stated, no torque at the device, and a clean start after it.
#include <limpid/device/usb/usb_omni.hpp>

#include "usb/usb_bench.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

using limpid::Status, limpid::UsbCount, limpid::UsbFault, limpid::UsbOmni;
using limpid::emulator::OmniFault;
using limpid::test::UsbBench;
using Vector = Eigen::Vector3d;

namespace {

const Vector wanted(0.03, 0.05, 0.02);  // N m

struct Expected {
  OmniFault fault;
  std::vector<UsbFault> stated;  // any of them
};

bool is_one_of(UsbFault fault, const std::vector<UsbFault>& stated) {
  return std::find(stated.begin(), stated.end(), fault) != stated.end();
}

void check_fault(UsbBench& bench, UsbOmni& omni, const std::vector<UsbFault>& stated) {
  CHECK(bench.loop(omni, wanted, [&](const auto& seen) { return limpid::has(seen.status, Status::fault); }));
  CHECK_MESSAGE(is_one_of(omni.fault(), stated), describe(omni.fault()));
  CHECK(bench.loop(omni, wanted, [&](const auto&) { return bench.omni.snapshot().torque.isZero(0); }));
}

void check_start(UsbBench& bench, UsbOmni& omni) {
  const auto commands = bench.omni.snapshot().commands;  // motors stay off until the fault is cleared
  CHECK(bench.loop(omni, wanted, [&](const auto&) { return bench.omni.snapshot().commands > commands + 20; }));
  CHECK(bench.omni.snapshot().torque.isZero(0));
  CHECK(bench.clear_and_start(omni, wanted));
  CHECK(bench.loop(omni, wanted, [&](const auto&) { return !bench.omni.snapshot().torque.isZero(0); }));
  CHECK(omni.fault() == UsbFault::none);
}

void check(const Expected& expected) {
  const std::string name(limpid::emulator::fault_names[static_cast<std::size_t>(expected.fault)]);
  CAPTURE(name);
  UsbBench bench;
  UsbOmni omni(bench.settings());
  REQUIRE(bench.start(omni, wanted));
  bench.omni.set(expected.fault);
  check_fault(bench, omni, expected.stated);
  bench.omni.clear_faults();
  check_start(bench, omni);
}

// What a UsbOmni bears, with its motors on.
void check_borne(OmniFault fault) {
  const std::string name(limpid::emulator::fault_names[static_cast<std::size_t>(fault)]);
  CAPTURE(name);
  UsbBench bench;
  UsbOmni omni(bench.settings());
  REQUIRE(bench.start(omni, wanted));
  bench.omni.set(fault);
  const auto states = omni.counters()[UsbCount::states];
  CHECK(bench.loop(omni, wanted, [&](const auto&) { return omni.counters()[UsbCount::states] > states + 40; }));
  CHECK(omni.fault() == UsbFault::none);
  CHECK(bench.omni.snapshot().motors_on);
}

}  // namespace

TEST_CASE("frames that are short, damaged, or of another protocol are none: the state is stale") {
  for (const OmniFault fault : {OmniFault::short_packet, OmniFault::corrupt, OmniFault::wrong_magic,
                                OmniFault::wrong_version, OmniFault::wrong_kind}) {
    check({fault, {UsbFault::stale}});
  }
}

TEST_CASE("a device that says nothing, or fails to, is stale") {
  for (const OmniFault fault : {OmniFault::babble, OmniFault::protocol_error, OmniFault::silence}) {
    check({fault, {UsbFault::stale}});
  }
}

TEST_CASE("a device that says the same thing again and again is stale") {
  check({OmniFault::stuck, {UsbFault::stale}});
}

TEST_CASE("a device that does not hear is silent, or says that its watchdog took its motors off") {
  for (const OmniFault fault : {OmniFault::protocol_error_out, OmniFault::out_stuck}) {
    check({fault, {UsbFault::device_silent, UsbFault::watchdog_off}});
  }
}

TEST_CASE("counts that leap are not believed") { check({OmniFault::absurd, {UsbFault::encoder_jumped}}); }

TEST_CASE("a device that was without power for a moment must be docked again") {
  UsbBench bench;
  UsbOmni omni(bench.settings());
  REQUIRE(bench.start(omni, wanted));
  bench.omni.reboot();
  check_fault(bench, omni, {UsbFault::power_cycled});
  CHECK(!omni.calibrated());
  check_start(bench, omni);
}

TEST_CASE("states that are lost, that come twice, or late, do no harm, and are counted") {
  for (const OmniFault fault : {OmniFault::lost, OmniFault::repeated, OmniFault::slow}) check_borne(fault);
}

TEST_CASE("a halt of an endpoint is cleared, and a few bad frames are borne") {
  UsbBench bench;
  UsbOmni omni(bench.settings());
  REQUIRE(bench.start(omni, wanted));
  const std::vector<std::pair<OmniFault, UsbCount>> faults{{OmniFault::stall_in, UsbCount::halts},
                                                           {OmniFault::stall_out, UsbCount::halts},
                                                           {OmniFault::corrupt, UsbCount::damaged},
                                                           {OmniFault::babble, UsbCount::in_errors}};
  for (const auto& [fault, count] : faults) {
    CAPTURE(static_cast<int>(fault));
    const auto before = omni.counters()[count], states = omni.counters()[UsbCount::states];
    CHECK(bench.loop(omni, wanted, [&, left = 0](const auto&) mutable {
      if (omni.counters()[count] > before) return omni.counters()[UsbCount::states] > states + 40;
      if (left-- == 0) {
        bench.omni.set(fault, 1);  // once more, where the machine was too slow to take that frame
        left = 100;
      }
      return false;
    }));
  }
  CHECK(omni.fault() == UsbFault::none);
}
