// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/loop/realtime/realtime_report.hpp>
#include <limpid/loop/realtime/realtime_thread.hpp>
#include <limpid/loop/realtime/steady_clock.hpp>

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <thread>
#include <type_traits>
#include <utility>

namespace limpid {

/// What a periodic loop does about ticks that are due while another one still runs.
enum class Overrun {
  skip,      ///< they are missed; the next tick comes at the next instant of the grid
  catch_up,  ///< they run at once, one after another; those that are too far behind are missed
  stop,      ///< the loop ends
};

/// When a tick runs.
struct TickTime {
  Time now{};                ///< its begin, by the clock
  Duration dt{};             ///< since the begin of the last tick, measured; of the first one: the period
  std::uint64_t index = 0;   ///< of the ticks that run, from 0
  std::uint64_t missed = 0;  ///< instants of the grid without a tick since the last one
};

/// A function of TickTime that does not throw, and returns nothing, whether to go on, or a Status: the loop ends where
/// that has `fault`.
template <typename T>
concept PeriodicTick = std::is_nothrow_invocable_v<T&, const TickTime&> &&
    (std::is_void_v<std::invoke_result_t<T&, const TickTime&>> ||
     std::same_as<std::invoke_result_t<T&, const TickTime&>, bool> ||
     std::same_as<std::invoke_result_t<T&, const TickTime&>, Status>);

struct PeriodicSettings {
  Duration period{};                    ///< of the grid, > 0
  Overrun overrun = Overrun::skip;      ///< what happens to ticks that are late by a period or more
  int most_behind = 4;                  ///< of catch_up: periods that a tick may be late, >= 0
  Duration duration = Duration::max();  ///< to run for, > 0; ticks are due before its end
  std::optional<Time> origin{};         ///< an instant of the grid, by the clock: to go with another; none: the begin
  RealtimeThread::Settings thread{};    ///< for as long as the loop runs
};

/// Calls a function at the instants of a grid of CLOCK_MONOTONIC that begins with the run, or goes with `origin`:
/// ```cpp
/// PeriodicLoop loop({.period = 1ms, .thread = {.priority = 80, .cpu = 1, .lock_memory = true}});
/// loop.run(stop, [&](const TickTime& at) noexcept { ... });  // on this thread, until a stop is requested
/// std::cout << describe(loop.report());
/// ```
/// A thread under SCHED_FIFO whose ticks always take longer than the period never sleeps with `catch_up`; with `skip`
/// it does.
/// @tparam Clock  a SleepingClock
/// @realtime      run: no allocation between the first tick and the last; a tick costs the calls of the clock, and two
///                entries into histograms
template <SleepingClock Clock = SteadyClock>
class PeriodicLoop {
 public:
  using Settings = PeriodicSettings;

  /// @throws std::invalid_argument  where a setting cannot serve
  explicit PeriodicLoop(const PeriodicSettings& settings, Clock clock = {})
      : settings_{settings}, clock_{std::move(clock)} {
    expect(settings.period > Duration::zero(), "PeriodicLoop: period", "> 0 s", settings.period);
    expect(settings.duration > Duration::zero(), "PeriodicLoop: duration", "> 0 s", settings.duration);
    expect(settings.most_behind >= 0, "PeriodicLoop: most_behind", ">= 0", settings.most_behind);
    settings.thread.check();
  }

  PeriodicLoop(const PeriodicLoop&) = delete;
  PeriodicLoop& operator=(const PeriodicLoop&) = delete;
  PeriodicLoop(PeriodicLoop&&) = delete;
  PeriodicLoop& operator=(PeriodicLoop&&) = delete;
  ~PeriodicLoop() = default;

  /// Runs on the calling thread. A stop that is requested in a tick is its last; while the thread sleeps, the loop ends
  /// when it would have ticked, or on a signal to that thread.
  /// @return  the report, which stays until the next run
  template <PeriodicTick Tick>
  const RealtimeReport& run(const std::stop_token& stop, Tick&& tick) {
    report_ = RealtimeReport{};
    const RealtimeThread thread(settings_.thread);
    report_.granted = thread.grants();
    report_.end = ticked(stop, tick);
    return report_;
  }

  /// Runs on a thread of its own, which ends within a period of the jthread's `request_stop` or destruction. The loop
  /// must outlive it.
  template <PeriodicTick Tick>
  [[nodiscard]] std::jthread start(Tick tick) {
    return std::jthread([this, tick = std::move(tick)](const std::stop_token& stop) mutable { run(stop, tick); });
  }

  /// Of the last run; while one is under way on another thread it must not be asked for.
  [[nodiscard]] const RealtimeReport& report() const noexcept { return report_; }

 private:
  template <typename Tick>
  LoopEnd ticked(const std::stop_token& stop, Tick& tick) noexcept {
    const Duration period = settings_.period;
    Time due = first_instant(clock_.now());
    const Time end = later(due, settings_.duration);
    TickTime at{};
    while (due < end) {
      if (!slept_until(due, stop)) return LoopEnd::stop_requested;
      const Time begin = clock_.now();
      const std::uint64_t late = given_up(due, begin);
      if (late > 0 && settings_.overrun == Overrun::stop) return LoopEnd::overrun;
      miss(late, due, at);
      at.dt = at.index == 0 ? period : elapsed(begin, at.now);
      at.now = begin;
      report_.lateness.add(begin - due);
      const bool goes_on = goes_on_after(tick, at);
      const Time done = clock_.now();
      report_.work.add(done - begin);
      at.missed = 0;
      at.index = ++report_.ticks;
      due = later(due, period);
      if (!goes_on) return LoopEnd::by_tick;
      if (done <= due) continue;
      ++report_.overruns;
      if (settings_.overrun == Overrun::stop) return LoopEnd::overrun;
      if (settings_.overrun == Overrun::skip) miss(instants(due, done), due, at);
    }
    return LoopEnd::duration;
  }

  [[nodiscard]] Time first_instant(Time now) const noexcept {
    if (!settings_.origin) return now;
    const Duration past = elapsed(now, *settings_.origin) % settings_.period;  // below 0 where the origin is to come
    return past > Duration::zero() ? later(now, settings_.period - past) : now - past;
  }

  bool slept_until(Time due, const std::stop_token& stop) noexcept {
    while (!stop.stop_requested()) {
      if (clock_.sleep_until(due)) return !stop.stop_requested();
    }
    return false;
  }

  // Of the grid, from `due` on and before `now`.
  [[nodiscard]] std::uint64_t instants(Time due, Time now) const noexcept {
    return static_cast<std::uint64_t>((now - due - Duration{1}) / settings_.period) + 1;
  }

  // How many periods a tick that begins now is too late for.
  [[nodiscard]] std::uint64_t given_up(Time due, Time now) const noexcept {
    const Duration::rep behind = (now - due) / settings_.period;
    const Duration::rep kept = settings_.overrun == Overrun::catch_up ? settings_.most_behind : 0;
    return static_cast<std::uint64_t>(std::max(behind - kept, Duration::rep{0}));
  }

  void miss(std::uint64_t count, Time& due, TickTime& at) noexcept {
    due += settings_.period * static_cast<Duration::rep>(count);
    at.missed += count;
    report_.missed += count;
  }

  template <typename Tick>
  bool goes_on_after(Tick& tick, const TickTime& at) noexcept {
    using Result = std::invoke_result_t<Tick&, const TickTime&>;
    if constexpr (std::is_void_v<Result>) {
      tick(at);
      return true;
    } else if constexpr (std::same_as<Result, bool>) {
      return tick(at);
    } else {
      const Status status = tick(at);
      report_.status |= status;
      return !has(status, Status::fault);
    }
  }

  PeriodicSettings settings_;
  Clock clock_;
  RealtimeReport report_{};
};

}  // namespace limpid
