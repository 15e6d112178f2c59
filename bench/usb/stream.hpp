// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/time.hpp>
#include <limpid/evaluation/latency_histogram.hpp>

#include <cstdint>
#include <vector>

namespace limpid::bench {

/// What a second of a loop at 1 kHz saw of its device.
struct StreamSecond {
  std::uint64_t states = 0;    ///< that came
  std::uint64_t taken = 0;     ///< of which the loop read; the others were replaced by newer ones before it looked
  std::uint64_t late = 0;      ///< of which the tick before could have read: they had come before it began
  std::uint64_t torn = 0;      ///< of which cannot be one state: parts of two
  std::uint64_t damaged = 0;   ///< frames
  std::uint64_t lost = 0;      ///< states
  std::uint64_t misses = 0;    ///< ticks that were missed, or ended after the next one was due
  std::uint64_t faults = 0;    ///< latched
  std::uint64_t pauses = 0;    ///< of the emulator: the machine held it up for more than 5 ms
  std::uint64_t replaced = 0;  ///< states that the emulator made and no transfer came for

  StreamSecond& operator+=(const StreamSecond& other) {
    states += other.states, taken += other.taken, late += other.late, torn += other.torn;
    damaged += other.damaged, lost += other.lost, misses += other.misses, faults += other.faults;
    pauses += other.pauses, replaced += other.replaced;
    return *this;
  }
};

/// What a call takes, the clock's own two calls of some 20 ns within.
struct CallCost {
  LatencyHistogram all;
  LatencyHistogram calm;  ///< of ticks in which the machine did not give the thread's processor to another one

  void add(Duration took, bool is_calm) noexcept {
    all.add(took);
    if (is_calm) calm.add(took);
  }
};

struct StreamFigures {
  std::vector<StreamSecond> seconds;
  CallCost read, write;
  CallCost same;              ///< arithmetic of about the same length that touches no memory: what the machine adds
  LatencyHistogram age;       ///< of the newest state, at each tick
  LatencyHistogram lateness;  ///< of the ticks
};

/// Runs a loop at 1 kHz with a UsbOmni for so many seconds.
[[nodiscard]] StreamFigures measure_stream(int seconds);

}  // namespace limpid::bench
