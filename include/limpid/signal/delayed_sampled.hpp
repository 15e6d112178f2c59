// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/signal/sample.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace limpid {

/// A signal sampled every `period`, seen `delay` later and held: x_zd(t), thesis section 4.3.2.
///
/// The sample k is taken at the first tick at or after k * period and stamped with that tick (the first tick takes the
/// newest k that is due); it arrives `delay` later and is seen by the first tick at or after that. Neither needs to be
/// a multiple of the tick, and the delay may exceed the period. A sampler with its own clock hands its samples to
/// `offer` instead. A value that is not finite when its sample is due makes that sample a lost one.
///
/// When samples stop coming, what is held grows older than `longest_age`, and `update` says `stale`. The sampler's own
/// sampling is stale only where samples were lost: slow ticks alone never make it so.
/// @tparam T         copied without throwing; `is_finite(T)` is found by argument-dependent lookup or in limpid
/// @tparam Capacity  most samples on their way at once
/// @realtime         no allocation, no throw; `update` looks at `value` only when a sample is due, `offer` moves each
///                   sample on its way that arrives later
template <typename T, std::size_t Capacity = 64>
class DelayedSampled {
 public:
  struct Settings {
    Duration period{};  ///< T_d, between samples; > 0
    Duration delay{};   ///< from taking a sample to its arrival; >= 0, below Capacity periods
    /// Age, since `taken`, from which on what is held is stale; before the first arrival, since the first tick. At
    /// least the delay and a period; default: the delay and ten periods.
    Duration longest_age = delay_and_periods(delay, period, 10);
  };

  /// @param initial  what is held before the first arrival, finite
  /// @throws std::invalid_argument  where the settings cannot serve
  explicit DelayedSampled(const Settings& settings, const T& initial = zero<T>())
      : period_{settings.period}, delay_{settings.delay}, longest_age_{std::min(settings.longest_age, longest)} {
    expect(period_ > Duration::zero(), "DelayedSampled: period", "> 0", period_);
    expect(delay_ >= Duration::zero(), "DelayedSampled: delay", ">= 0", delay_);
    expect(static_cast<std::size_t>(delay_ / period_) < Capacity, "DelayedSampled: delay",
           "below " + std::to_string(Capacity) + " periods", delay_);
    expect(longest_age_ >= delay_and_periods(delay_, period_, 1), "DelayedSampled: longest_age",
           "at least the delay and a period", longest_age_);
    expect(is_finite(initial), "DelayedSampled: initial", "finite", "a value that is not");
    held().value = initial;
    held().status = Status::no_sample;
  }

  /// What is seen at `now`; takes a sample of `value` if one is due. The answer changes with the next call.
  /// @return status  `no_sample` before the first arrival; `not_finite`: a due sample was lost;
  ///                 `clock_backwards`: `now` is not after the last tick, nothing changed;
  ///                 `out_of_order`: an arrival was not newer than what is held;
  ///                 `stale`: samples were lost, and what is held is older than `longest_age`
  [[nodiscard]] const Held<T>& update(Time now, const T& value) noexcept {
    if (started_ && now <= now_) return seen(false, Status::clock_backwards);
    Status status = Status::ok;
    if (!started_ || now >= next_due_) {
      status = take(now, value);
      next_due_ = due_after(now);
    }
    return deliver(now, status, lost_);
  }

  /// What is seen at `now`, when all samples come by `offer`.
  /// @return status  as above; `stale`: what is held is older than `longest_age`
  [[nodiscard]] const Held<T>& update(Time now) noexcept {
    if (started_ && now <= now_) return seen(false, Status::clock_backwards);
    return deliver(now, Status::ok, now);
  }

  /// Sends a sample with its own clock on its way: it will be seen by the first tick at or after `sample.arrived`.
  /// @return  `not_finite`, `clock_backwards` (arrived before it was taken), `out_of_order` (not newer than what is
  ///          held, or a repetition of one on its way): the sample was dropped;
  ///          `overflow`: too many are on their way; the earliest arrival was dropped for it, or the latest, which may
  ///          be the sample itself, where that is more than `longest_age` after the last tick
  [[nodiscard]] Status offer(const Sample<T>& sample) noexcept {
    if (!is_finite(sample.value)) return Status::not_finite;
    if (sample.arrived < sample.taken) return Status::clock_backwards;
    if (arrived_any() && sample.taken <= held().taken) return Status::out_of_order;
    for (std::size_t i = 0; i < count_; ++i) {
      if (slot(i).taken == sample.taken) return Status::out_of_order;
    }
    return send(sample.value, sample.taken, sample.arrived, now_, Capacity + 1);
  }

 private:
  // Of samples taken in (now - delay, now] there are at most ceil(delay / period) + 1. One more is taken before those
  // that have arrived by the same tick leave, and one is held.
  static constexpr std::size_t slots = Capacity + 3;

  static constexpr Duration longest = Duration::max() / 2;  // of an age

  static constexpr Duration delay_and_periods(Duration delay, Duration period, int periods) noexcept {
    if (delay < Duration::zero() || period < Duration::zero()) return longest;  // refused elsewhere
    return delay > longest || period > (longest - delay) / periods ? longest : delay + period * periods;
  }

  [[nodiscard]] bool arrived_any() const noexcept { return any_; }

  // The first multiple of the period after `now`; without a division where no period was missed.
  [[nodiscard]] Time due_after(Time now) const noexcept {
    const Time next = later(next_due_, period_);
    return started_ && now < next ? next : multiple_after(now);
  }

  [[nodiscard]] Time multiple_after(Time t) const noexcept {
    const Time multiple = period_ * (t / period_);  // between t and zero
    return multiple > t ? multiple : later(multiple, period_);
  }

  Status take(Time now, const T& value) noexcept {
    if (!is_finite(value)) {
      lost_ = now;
      return Status::not_finite;
    }
    return send(value, now, later(now, delay_), now, Capacity + 2);
  }

  // Keeps the ring in the order of arrival, `most` of them. What arrives too far ahead cannot keep out what is to come
  // sooner.
  Status send(const T& value, Time taken, Time arrived, Time now, std::size_t most) noexcept {
    const bool full = count_ >= most;
    if (full) {
      const Time latest = std::max(slot(count_ - 1).arrived, arrived);
      if (!started_ || elapsed(latest, now) <= longest_age_) {
        drop_front();
      } else if (latest == arrived) {
        return Status::overflow;
      } else {
        --count_;
      }
    }
    std::size_t i = count_++;
    for (; i > 0 && is_later(slot(i - 1), taken, arrived); --i) slot(i) = slot(i - 1);
    Held<T>& sample = slot(i);
    sample.value = value;
    sample.taken = taken;
    sample.arrived = arrived;
    return when(full, Status::overflow);
  }

  static bool is_later(const Held<T>& a, Time taken, Time arrived) noexcept {
    return a.arrived > arrived || (a.arrived == arrived && a.taken > taken);
  }

  // A sample taken at or after what is held, up to the instant `owed`, should have been there by now.
  [[nodiscard]] const Held<T>& deliver(Time now, Status status, Time owed) noexcept {
    if (!started_) first_tick_ = now;
    started_ = true;
    now_ = now;
    bool fresh = false;
    while (count_ > 0 && slot(0).arrived <= now) {
      if (arrived_any() && slot(0).taken <= held().taken) {
        status |= Status::out_of_order;
        drop_front();
      } else {
        hold_front();
        any_ = fresh = true;
      }
    }
    const Time since = arrived_any() ? held().taken : first_tick_;
    return seen(fresh, status | when(elapsed(now, since) > longest_age_ && since <= owed, Status::stale));
  }

  [[nodiscard]] const Held<T>& seen(bool fresh, Status status) noexcept {
    held().fresh = fresh;
    held().status = status | when(!any_, Status::no_sample);
    return held();
  }

  // The one as last seen; those on their way follow it.
  Held<T>& held() noexcept { return ring_[held_]; }
  Held<T>& slot(std::size_t i) noexcept {
    const std::size_t at = held_ + 1 + i;
    return ring_[at < slots ? at : at - slots];
  }

  void hold_front() noexcept {
    held_ = held_ + 1 < slots ? held_ + 1 : 0;
    --count_;
  }
  void drop_front() noexcept {
    slot(0) = held();
    hold_front();
  }

  Duration period_;
  Duration delay_;
  Duration longest_age_;
  bool started_ = false, any_ = false;
  Time first_tick_{}, now_{};          // and the last tick
  Time next_due_{};                    // of the next sample
  Time lost_ = Time::min();            // the last due sample that was not finite
  std::size_t held_ = 0, count_ = 0;   // where in the ring; how many are on their way
  std::array<Held<T>, slots> ring_{};  // by arrival
};

}  // namespace limpid
