// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/usb/usb_protocol.hpp>

#include <chrono>
#include <string>
#include <vector>

namespace limpid {

struct UsbLinkSettings {
  std::string path{};                                        ///< of the device, "1-2.4"; empty: there is only one
  std::vector<UsbIdentity> identities{};                     ///< of the devices to serve; empty: the protocol's
  Duration device_watchdog = std::chrono::milliseconds(20);  ///< what the device is told, 1 ms to 1 s
  Duration host_watchdog = std::chrono::milliseconds(15);    ///< between commands of the loop, 2 ms to 1 s
  Duration stale_after = std::chrono::milliseconds(10);      ///< without a new state, 2 ms to 1 s
  Duration poll = std::chrono::microseconds(
      250);  ///< without a state, until a new command is looked for, 50 us to 1 ms; libusb may wait for a whole ms
  int priority = 0;  ///< SCHED_FIFO of the thread that serves libusb, 1 to 99, where permitted; 0: as its maker
  Duration search_every = std::chrono::milliseconds(100);  ///< for a device that went away, 10 ms to 10 s

  /// Itself. @throws std::invalid_argument  where a field cannot serve
  [[nodiscard]] const UsbLinkSettings& checked() const {
    using namespace std::chrono_literals;
    const auto within = [](Duration value, Duration least, Duration most, const char* field, const char* words) {
      expect(value >= least && value <= most, std::string("UsbLink: ") + field, words, value);
    };
    within(device_watchdog, 1ms, 1s, "device_watchdog", "from 1 ms to 1 s");
    within(host_watchdog, 2ms, 1s, "host_watchdog", "from 2 ms to 1 s");
    within(stale_after, 2ms, 1s, "stale_after", "from 2 ms to 1 s");
    within(poll, 50us, 1ms, "poll", "from 50 us to 1 ms");
    expect(priority >= 0 && priority <= 99, "UsbLink: priority", "from 0 to 99", priority);
    within(search_every, 10ms, 10s, "search_every", "from 10 ms to 10 s");
    return *this;
  }
};

}  // namespace limpid
