// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/loop/realtime/environment_exchange.hpp>
#include <limpid/loop/realtime/steady_clock.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

namespace limpid {

/// A tool in its environment that moves by the operator's force, such as a VirtualTool.
template <typename T, typename Exchange>
concept ForcedTool = requires(T& tool, const typename Exchange::Vector& F_h) {
  { tool.advance(Time{}, F_h).value } -> std::convertible_to<typename Exchange::State>;
  { tool.advance(Time{}, F_h).status } -> std::convertible_to<Status>;
};

struct SlowEnvironmentSettings {
  Duration period{};  ///< T_d, between samples, by the environment's clock; > 0
  Duration delay{};   ///< from taking a sample to handing it on; >= 0, below 64 periods
};

/// An environment that is truly slow and late: once a period it moves the tool through all of the operator's forces
/// since, in their order and by their instants, and hands on the tool's state a delay later, stamped with the newest of
/// them. Where no force has come it hands on nothing.
/// ```cpp
/// EnvironmentExchange<> exchange;
/// SlowEnvironment tissue(exchange, VirtualTool<KelvinVoigt<1>>({...}), {.period = 16ms, .delay = 20ms});
/// const std::jthread thread = tissue.start();   // or serve(stop), in a process of its own
/// ```
/// @realtime  step: no allocation and no throw but the tool's
template <typename Exchange, ForcedTool<Exchange> Tool>
class SlowEnvironment {
 public:
  using Settings = SlowEnvironmentSettings;

  /// @param exchange  must outlive this
  /// @throws std::invalid_argument  where a setting cannot serve
  SlowEnvironment(Exchange& exchange, Tool tool, const SlowEnvironmentSettings& settings)
      : end_{exchange}, tool_{std::move(tool)}, settings_{settings} {
    expect(settings.period > Duration::zero(), "SlowEnvironment: period", "> 0 s", settings.period);
    expect(settings.delay >= Duration::zero(), "SlowEnvironment: delay", ">= 0 s", settings.delay);
    expect(settings.delay / settings.period < most, "SlowEnvironment: delay",
           "below " + std::to_string(most) + " periods", settings.delay);
  }

  /// Does what is due at `now`, which must not go backwards.
  /// @return  when something is due again
  Time step(Time now) noexcept {
    if (!started_ || now >= next_) {
      if (!started_) next_ = now;
      started_ = true;
      sample(now);
      next_ += settings_.period * ((now - next_) / settings_.period + 1);
    }
    while (count_ > 0 && first().due <= now) {
      end_.publish(first().taken, first().state);
      first_ = (first_ + 1) % slots;
      --count_;
    }
    return count_ > 0 ? std::min(next_, first().due) : next_;
  }

  /// Runs on the calling thread until a stop is requested, and ends within 20 ms of that.
  template <SleepingClock Clock = SteadyClock>
  void serve(const std::stop_token& stop, Clock clock = {}) noexcept {
    while (!stop.stop_requested()) {
      const Time next = step(clock.now());
      (void)clock.sleep_until(std::min(next, clock.now() + std::chrono::milliseconds(20)));
    }
  }

  /// Runs on a thread of its own, until that is stopped or destroyed; this must outlive it.
  [[nodiscard]] std::jthread start() {
    return std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }

  /// Of all steps, joined: the tool's, and `overflow` where forces were lost. Not while it runs on another thread.
  [[nodiscard]] Status status() const noexcept { return status_; }

 private:
  static constexpr Duration::rep most = 64;
  static constexpr std::size_t slots = most + 2;  // taken within a delay, and the one taken before those due leave

  struct Late {
    Time due{}, taken{};
    typename Exchange::State state{};
  };

  void sample(Time now) noexcept {
    bool moved = false;
    Late late{.due = later(now, settings_.delay)};
    status_ |= end_.forces([&](Time at, const typename Exchange::Vector& F_h) noexcept {
      const auto output = tool_.advance(at, F_h);
      status_ |= output.status;
      if (output.status != Status::ok) return;  // it is not where it should be at that instant
      late.taken = at;
      late.state = output.value;
      moved = true;
    });
    if (!moved) return;
    late_[(first_ + count_) % slots] = late;
    ++count_;
  }

  [[nodiscard]] const Late& first() const noexcept { return late_[first_]; }

  EnvironmentEnd<Exchange> end_;
  Tool tool_;
  SlowEnvironmentSettings settings_;
  bool started_ = false;
  Time next_{};  // sample
  std::size_t first_ = 0, count_ = 0;
  std::array<Late, slots> late_{};  // a ring of samples to be handed on
  Status status_ = Status::ok;
};

}  // namespace limpid
