// SPDX-License-Identifier: MIT
// What is plugged in that limpid knows, and what an Omni says in a second. Its motors are off.
#include "common/usb_omni_options.hpp"
#include "common/usb_words.hpp"

#include <limpid/loop/realtime/periodic_loop.hpp>
#include <limpid/loop/realtime/stop_on_signal.hpp>

#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>

using namespace limpid;
using namespace limpid::examples;
using namespace std::chrono_literals;

namespace {

constexpr int beyond_a_start = 100;  // ms until the first states have come

void print_state(const UsbOmni& omni, const DeviceState<3>& seen) {
  const OmniBridge::State& state = omni.state();
  std::printf("  docked %s, angles %s, power-ups %u, device time %.3f s\n", state.docked ? "yes" : "no",
              omni.calibrated() ? "known" : "unknown until it is docked", unsigned{state.boots},
              1e-6 * state.device_time);
  std::printf("  device's watchdog: motors %s; commands %s\n", state.watchdog_off ? "taken off" : "not taken off",
              state.refuses ? "refused until one with motors off" : "taken");
  std::printf("  counts   %9d %9d %9d\n", state.encoder[0], state.encoder[1], state.encoder[2]);
  if (omni.calibrated()) {
    std::printf("  q        %9.4f %9.4f %9.4f rad\n", seen.q[0], seen.q[1], seen.q[2]);
    std::printf("  gimbal   %9.4f %9.4f %9.4f rad\n", seen.gimbal[0], seen.gimbal[1], seen.gimbal[2]);
  }
  std::printf("  buttons  %s %s\n", state.pressed[0] ? "pressed" : "up", state.pressed[1] ? "pressed" : "up");
  std::printf("  status   %s; %s\n", limpid::describe(seen.status).c_str(),
              std::string(limpid::describe(omni.fault())).c_str());
}

int watch(UsbOmni& omni) {
  std::stop_source stop;
  const StopOnSignal on_signal(stop);
  DeviceState<3> seen;
  std::uint64_t from = 0;
  Time first{}, last{};
  PeriodicLoop loop({.period = 1ms, .duration = 1s + 1ms * beyond_a_start});
  loop.run(stop.get_token(), [&](const TickTime& at) noexcept {
    seen = omni.read(at.now);
    if (at.index <= beyond_a_start) {
      from = omni.states();
      first = at.now;
    }
    last = at.now;
  });
  if (omni.states() == 0) {
    std::cerr << "omni_info: expected states of the Omni, got none: " << limpid::describe(omni.fault()) << '\n';
    return 1;
  }
  const double time = in_seconds(last - first);
  if (time > 0) std::printf("  %.0f states/s over %.2f s\n", static_cast<double>(omni.states() - from) / time, time);
  print_state(omni, seen);
  std::fputs(examples::describe(omni.counters()).c_str(), stdout);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Lists what is plugged in that limpid knows, opens an Omni with its motors off, and prints what it says.");
  UsbOmniOptions options;
  add_usb_omni_options(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    const UsbOmni::Settings settings = options.reading_only();
    const UsbContext context = make_usb_context();
    std::cout << "plugged in:\n"
              << known_devices(list_usb_devices(context.get()), options.link.identities) << std::flush;
    UsbOmni omni(settings);
    std::cout << "Omni, motors off:" << std::endl;
    return watch(omni);
  } catch (const std::exception& error) {
    std::cerr << "omni_info: " << error.what() << '\n';
    return 1;
  }
}
