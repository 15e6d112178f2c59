// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <chrono>

namespace limpid {

/// Time since the start of the run. An integer count, because a float cannot count milliseconds for an hour;
/// only differences become `Scalar` seconds.
using Time = std::chrono::nanoseconds;
using Duration = std::chrono::nanoseconds;

/// @realtime  no allocation for built-in scalars
template <Real Scalar = double>
[[nodiscard]] constexpr Scalar in_seconds(Duration duration) {
  return static_cast<Scalar>(duration.count()) / static_cast<Scalar>(1'000'000'000);
}

/// From `earlier` to `later`, held at the ends of the range where the difference would leave it.
/// @realtime  no allocation, no throw
[[nodiscard]] constexpr Duration elapsed(Time later, Time earlier) noexcept {
  Duration::rep difference{};
  if (!__builtin_sub_overflow(later.count(), earlier.count(), &difference)) return Duration{difference};
  return later < earlier ? Duration::min() : Duration::max();
}

/// `duration`, >= 0, after `time`; held at the end of the range.
/// @realtime  no allocation, no throw
[[nodiscard]] constexpr Time later(Time time, Duration duration) noexcept {
  Duration::rep sum{};
  return __builtin_add_overflow(time.count(), duration.count(), &sum) ? Time::max() : Time{sum};
}

/// Where `time` is on the way from `from`, 0, to `to`, 1; between them, and from < to.
/// @realtime  no allocation for built-in scalars, no throw
template <Real Scalar>
[[nodiscard]] constexpr Scalar part_of_way(Time time, Time from, Time to) {
  Duration::rep whole{};
  if (!__builtin_sub_overflow(to.count(), from.count(), &whole)) [[likely]]
    return static_cast<Scalar>((time - from).count()) / static_cast<Scalar>(whole);
  // more than 292 years: a nanosecond does not count
  return static_cast<Scalar>((time / 2 - from / 2).count()) / static_cast<Scalar>((to / 2 - from / 2).count());
}

/// Time by the machine's monotonic clock, CLOCK_MONOTONIC: one origin for all threads and processes of a machine.
/// @realtime  no allocation, no throw
[[nodiscard]] inline Time steady_now() noexcept { return std::chrono::steady_clock::now().time_since_epoch(); }

/// The nearest duration to `seconds`, which must be finite and below 292 years.
[[nodiscard]] inline Duration from_seconds(double seconds) { return Duration{std::llround(seconds * 1e9)}; }

}  // namespace limpid
