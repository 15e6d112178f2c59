// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/time.hpp>

#include <cerrno>
#include <concepts>
#include <ctime>

namespace limpid {

/// A clock that a thread can sleep by: `now()`, and `sleep_until(time)`, which says whether it has slept until then; it
/// has not where a signal woke it. Both are `noexcept`. Tests have one that they turn themselves.
template <typename C>
concept SleepingClock = requires(C& clock, Time time) {
  { clock.now() }
  noexcept->std::same_as<Time>;
  { clock.sleep_until(time) }
  noexcept->std::same_as<bool>;
};

/// CLOCK_MONOTONIC, by absolute times: what a tick takes does not shift the next one.
/// @realtime  no allocation, no throw
struct SteadyClock {
  [[nodiscard]] static Time now() noexcept { return steady_now(); }

  [[nodiscard]] static bool sleep_until(Time time) noexcept {
    constexpr Time second = std::chrono::seconds(1);
    const std::timespec until{.tv_sec = static_cast<std::time_t>(time / second),
                              .tv_nsec = static_cast<long>((time % second).count())};
    return clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != EINTR;
  }
};

}  // namespace limpid
