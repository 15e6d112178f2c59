// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/evaluation/latency_histogram.hpp>
#include <limpid/loop/realtime/realtime_thread.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>

namespace limpid {

/// Why a periodic loop has ended.
enum class LoopEnd {
  stop_requested,  ///< by the stop token
  by_tick,         ///< the tick returned false, or a status with `fault`
  overrun,         ///< a tick came or ended a period late, and the loop was to stop then
  duration,        ///< the time it was to run for is over
};

/// What a periodic loop came to. 37 kB.
struct RealtimeReport {
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;     ///< instants of the grid without a tick
  std::uint64_t overruns = 0;   ///< ticks that ended after the next one was due
  LatencyHistogram lateness{};  ///< from the instant a tick was due to its begin
  LatencyHistogram work{};      ///< from the begin of a tick to its end
  Status status = Status::ok;   ///< of all ticks, joined, where they return one
  LoopEnd end = LoopEnd::duration;
  RealtimeGrants granted{};
};

/// For people, in a few lines.
[[nodiscard]] inline std::string describe(const RealtimeReport& report) {
  constexpr std::array<std::string_view, 4> ends{"a stop was requested", "the tick ended it", "an overrun ended it",
                                                 "its time was over"};
  std::ostringstream text;
  const auto quantiles = [&text](std::string_view name, const LatencyHistogram& of) {
    const auto us = [](Duration duration) { return 1e6 * in_seconds(duration); };
    text << name << ": half within " << us(of.quantile(0.5)) << " us, 99 % within " << us(of.quantile(0.99))
         << " us, longest " << us(of.max()) << " us\n";
  };
  text << report.ticks << " ticks, " << report.missed << " missed, " << report.overruns << " overran; "
       << ends.at(static_cast<std::size_t>(report.end)) << "; status: " << describe(report.status) << '\n';
  quantiles("lateness", report.lateness);
  quantiles("work", report.work);
  const RealtimeGrants& granted = report.granted;
  text << "granted:" << (granted.fifo ? " SCHED_FIFO" : "") << (granted.pinned ? " processor" : "")
       << (granted.memory_locked ? " locked memory" : "")
       << (granted.fifo || granted.pinned || granted.memory_locked ? "" : " nothing of real time") << '\n';
  for (const std::string& sentence : granted.refused) text << "refused: " << sentence << '\n';
  return text.str();
}

}  // namespace limpid
