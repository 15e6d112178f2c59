// SPDX-License-Identifier: MIT
// A palpation by the machine's clock: what it runs on, and what it came to.
#pragma once

#include <limpid/core/time.hpp>
#include <limpid/device/usb/omni_calibration.hpp>
#include <limpid/evaluation/latency_histogram.hpp>
#include <limpid/loop/realtime/realtime_report.hpp>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace limpid::examples {

enum class DeviceKind { simulated, usb };

/// How the loop runs, where it does so by the machine's clock, with the tissue on a thread of its own.
struct LiveSettings {
  DeviceKind device = DeviceKind::simulated;
  OmniCalibration calibration{};  ///< of a device on USB
  std::string usb_path{};         ///< which one; empty: the only one
  int priority = 0;               ///< SCHED_FIFO of the loop and of what serves its device; 0: none
  bool lock_memory = false;

  /// A tissue that has given no sample for so long has its force taken away, over `fade_out`.
  [[nodiscard]] static Duration longest_age(Duration period, Duration delay) {
    return 2 * (period + delay) + std::chrono::milliseconds(100);
  }
  static constexpr Duration fade_out = std::chrono::milliseconds(50), fade_in = std::chrono::milliseconds(200),
                            hold = std::chrono::milliseconds(50);
};

/// What a device on USB came to.
struct LiveDeviceReport {
  double states_per_second = 0;
  double used_in_their_tick = 1;  ///< share of the states that a tick has read before the next one came
  std::uint64_t lost = 0, damaged = 0, commands = 0, dropped = 0;
  LatencyHistogram calls{};  ///< read and write of a tick together
  std::string fault{};       ///< empty: none
};

struct LiveReport {
  RealtimeReport loop{};
  std::uint64_t samples = 0;        ///< of the tissue
  std::uint64_t without_force = 0;  ///< ticks with less than all of it, since the tissue was stale
  LiveDeviceReport device{};
};

}  // namespace limpid::examples
