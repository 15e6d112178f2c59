// SPDX-License-Identifier: MIT
#include "usb/faults.hpp"

#include "usb/rig.hpp"

#include <emulator/child_process.hpp>
#include <emulator/omni_fault.hpp>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <thread>

namespace limpid::bench {
namespace {

using namespace std::chrono_literals;
using emulator::OmniFault;

constexpr Duration longest_fault = 500ms, borne_for = 200ms;
constexpr Duration held_up_by = 5ms;
constexpr std::size_t most_without_torque = 10;  // attempts

// Ends of a host, and the faults of its device.
enum class Cause { device, unplug, reboot, loop_silent, destructor, exception, killed };

struct Case {
  FaultRow row;
  Cause cause = Cause::device;
  OmniFault fault{};
};

std::vector<UsbFault> expected_of(OmniFault fault) {
  switch (fault) {
    case OmniFault::stall_in:
    case OmniFault::stall_out:
    case OmniFault::lost:
    case OmniFault::repeated:
    case OmniFault::frozen:
    case OmniFault::slow:
      return {};
    case OmniFault::protocol_error_out:
    case OmniFault::out_stuck:
    case OmniFault::out_refused:
      return {UsbFault::device_silent, UsbFault::watchdog_off};
    case OmniFault::absurd:
      return {UsbFault::encoder_jumped};
    default:
      return {UsbFault::stale};
  }
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (std::size_t i = 0; i < emulator::fault_names.size(); ++i) {
    const auto fault = static_cast<OmniFault>(i);
    all.push_back({.row = {.name = emulator::fault_names[i], .expected = expected_of(fault)}, .fault = fault});
  }
  all.push_back({.row = {.name = "unplug", .expected = {UsbFault::disconnected}}, .cause = Cause::unplug});
  all.push_back({.row = {.name = "reboot", .expected = {UsbFault::power_cycled}}, .cause = Cause::reboot});
  all.push_back({.row = {.name = "loop-silent", .expected = {UsbFault::loop_silent, UsbFault::watchdog_off}},
                 .cause = Cause::loop_silent});
  all.push_back({.row = {.name = "destructor", .expected = {}, .stated = false}, .cause = Cause::destructor});
  all.push_back({.row = {.name = "exception", .expected = {}, .stated = false}, .cause = Cause::exception});
  all.push_back({.row = {.name = "SIGKILL", .expected = {}, .stated = false}, .cause = Cause::killed});
  return all;
}

template <typename Condition>
bool comes(Duration longest, Condition&& condition) {
  const Time end = steady_now() + longest;
  while (!condition() && steady_now() < end) std::this_thread::sleep_for(1ms);
  return condition();
}

// A case once, on a rig that goes on to the next time.
class Once {
 public:
  Once(Rig& rig, const Case& of) : rig_{rig}, case_{of} {}

  FaultRun run() {
    run_.began = rig_.start() && rig_.loop(50ms, [](const auto&, const TickTime&) { return false; }) == false &&
                 rig_.omni->fault() == UsbFault::none && rig_.device.snapshot().motors_on;
    if (!run_.began) return run_;
    const auto pauses = rig_.device.snapshot().pauses;
    onset_ = steady_now();
    last_ = onset_;
    happen();
    const auto is = rig_.device.snapshot();
    if (!is.motors_on && is.motors_until) run_.to_zero = std::max(*is.motors_until - onset_, Duration::zero());
    run_.held_up = held_up_ || is.pauses != pauses;
    end();
    run_.restarted = rig_.start();
    return run_;
  }

 private:
  void happen() {
    switch (case_.cause) {
      case Cause::destructor:
        rig_.omni.reset();
        return;
      case Cause::exception:
        try {
          const auto gone = std::exchange(rig_.omni, nullptr);
          throw std::runtime_error("in the loop");
        } catch (const std::runtime_error&) {
        }
        return;
      case Cause::device:
        rig_.device.set(case_.fault);
        break;
      case Cause::unplug: {
        const std::jthread hand([&] { rig_.device.unplug(); });  // which takes milliseconds
        watch();
        return;
      }
      case Cause::reboot:
        rig_.device.reboot();
        break;
      case Cause::loop_silent:
      case Cause::killed:
        break;
    }
    watch();
  }

  // Until the fault is stated and the torque is gone; what is borne is looked at for a while.
  void watch() {
    const bool writes = case_.cause != Cause::loop_silent;
    (void)rig_.loop(
        case_.row.borne() ? borne_for : longest_fault,
        [&](const auto& seen, const TickTime& at) {
          held_up_ = held_up_ || at.now - last_ > 1ms + held_up_by;
          last_ = at.now;
          if (!run_.to_stated && has(seen.status, Status::fault)) {
            run_.to_stated = at.now - onset_;
            run_.stated = rig_.omni->fault();
          }
          return run_.to_stated && !rig_.device.snapshot().motors_on;
        },
        writes);
  }

  void end() {
    rig_.device.clear_faults();
    if (case_.cause == Cause::unplug) rig_.device.plug();
  }

  Rig& rig_;
  const Case& case_;
  FaultRun run_;
  Time onset_{}, last_{};
  bool held_up_ = false;
};

// A host in a process of its own is killed with SIGKILL while there is torque, and another one follows it.
FaultRun kill_once(Rig& rig) {
  rig.omni.reset();
  FaultRun run;
  emulator::ChildProcess host({"/proc/self/exe", "--as-host"});
  rig.device.set_docked(true);
  const auto commands = rig.device.snapshot().commands;
  if (!comes(10s, [&] { return rig.device.snapshot().commands > commands + 100; })) return run;
  rig.device.set_docked(false);
  run.began = comes(10s, [&] { return rig.device.snapshot().motors_on; });
  std::this_thread::sleep_for(50ms);
  const auto before = rig.device.snapshot();
  run.began = run.began && before.motors_on && !before.torque.isZero(0);
  const Time onset = steady_now();
  host.signal(SIGKILL);
  (void)comes(longest_fault, [&] { return !rig.device.snapshot().motors_on; });
  const auto is = rig.device.snapshot();
  if (!is.motors_on && is.motors_until) run.to_zero = std::max(*is.motors_until - onset, Duration::zero());
  run.held_up = is.pauses != before.pauses;
  (void)comes(10s, [&] { return host.ended().has_value() && !rig.device.snapshot().claimed; });
  run.restarted = rig.start();
  return run;
}

}  // namespace

std::vector<FaultRow> measure_faults(int repeats) {
  std::vector<FaultRow> rows;
  if (repeats == 0) return rows;
  for (Case& each : cases()) {
    auto rig = std::make_unique<Rig>();
    const auto wanted = static_cast<std::size_t>(repeats);
    while (each.row.runs.size() < wanted && each.row.without_torque < most_without_torque) {
      const FaultRun run = each.cause == Cause::killed ? kill_once(*rig) : Once(*rig, each).run();
      if (run.began) {
        each.row.runs.push_back(run);
      } else {
        ++each.row.without_torque;
      }
      if (!run.began || !run.restarted) {
        rig.reset();
        rig = std::make_unique<Rig>();
      }
    }
    rows.push_back(std::move(each.row));
  }
  return rows;
}

int hold_until_killed() {
  UsbOmni omni(Rig::adapter());
  SafetyLimiter<Omni<>> limiter{SafetyLimiter<Omni<>>::Settings{}};
  PeriodicLoop loop({.period = 1ms, .duration = 60s});
  loop.run(std::stop_token{}, [&](const TickTime& at) noexcept {
    const auto seen = omni.read(at.now);
    if (limiter.reason() != FaultReason::none) limiter.reset(at.now);
    if (omni.fault() != UsbFault::none) omni.clear_fault();
    (void)omni.write(limiter.limit(at.now, seen.joint_state(), Rig::wanted(seen)).torque);
  });
  return 0;
}

}  // namespace limpid::bench
