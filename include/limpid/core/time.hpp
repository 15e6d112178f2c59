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

/// The nearest duration to `seconds`, which must be finite and below 292 years.
[[nodiscard]] inline Duration from_seconds(double seconds) { return Duration{std::llround(seconds * 1e9)}; }

}  // namespace limpid
