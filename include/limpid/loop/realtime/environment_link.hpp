// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/loop/realtime/environment_exchange.hpp>
#include <limpid/signal/sample.hpp>

namespace limpid {

struct EnvironmentLinkSettings {
  Duration longest_age{};  ///< since `taken`, from which on what is held is stale; before any sample, since the first
                           ///< read; > 0: a period and the delay at least
};

/// The fast loop's end of an EnvironmentExchange. What it reads is what DelayedSampled sees of a simulated environment,
/// and predictors take it likewise:
/// ```cpp
/// (void)link.send(now, F_h);
/// const auto& seen = link.read(now);
/// if (seen.fresh) (void)predictor.observe({seen.value, seen.taken, seen.arrived});
/// ```
/// Where the environment dies or stalls, a force that a Fade takes away while the status is not `ok` is zero at any
/// tick that comes `longest_age` and `fade_out` after the last sample was taken.
/// @realtime  send, read: no allocation, no throw, never wait
template <typename Exchange>
class EnvironmentLink {
 public:
  using Vector = typename Exchange::Vector;
  using State = typename Exchange::State;

  using Settings = EnvironmentLinkSettings;

  /// @param exchange  must outlive the link
  /// @throws std::invalid_argument  where the setting cannot serve
  EnvironmentLink(Exchange& exchange, const EnvironmentLinkSettings& settings)
      : exchange_{&exchange}, longest_age_{settings.longest_age} {
    expect(longest_age_ > Duration::zero(), "EnvironmentLink: longest_age", "> 0 s", longest_age_);
    held_.status = Status::no_sample;
  }

  /// Hands the operator's force at `now`, N, to the environment.
  /// @return  `not_finite`, `clock_backwards` (not after the last one): it was not sent
  Status send(Time now, const Vector& F_h) noexcept {
    if (!is_finite(F_h)) return Status::not_finite;
    if (sent_any_ && now <= sent_) return Status::clock_backwards;
    sent_ = now;
    sent_any_ = true;
    exchange_->forces.write({now, Exchange::entries(F_h)});
    return Status::ok;
  }

  /// The newest state of the tool that has arrived by now. The answer changes with the next call.
  /// @return status  `no_sample` before the first one; `stale`: older than `longest_age`, or none for so long;
  ///                 `not_finite`, `out_of_order` (not newer than what is held), `clock_backwards` (taken after `now`):
  ///                 what arrived was dropped
  [[nodiscard]] const Held<State>& read(Time now) noexcept {
    if (!read_any_) since_ = now;
    read_any_ = true;
    held_.fresh = false;
    const Status refused = exchange_->sample.take() ? accept(now) : Status::ok;
    held_.status = refused | when(!any_, Status::no_sample) | when(elapsed(now, since_) > longest_age_, Status::stale);
    return held_;
  }

 private:
  Status accept(Time now) noexcept {
    const typename Exchange::Taken& taken = exchange_->sample.value();
    if (taken.at > now) return Status::clock_backwards;
    if (any_ && taken.at <= held_.taken) return Status::out_of_order;
    const State state{Exchange::vector(taken.x), Exchange::vector(taken.v), Exchange::vector(taken.a),
                      Exchange::vector(taken.F_e)};
    if (!is_finite(state)) return Status::not_finite;
    held_ = {.value = state, .taken = taken.at, .arrived = now, .fresh = true};
    since_ = taken.at;
    any_ = true;
    return Status::ok;
  }

  Exchange* exchange_;
  Duration longest_age_;
  Held<State> held_{};
  bool any_ = false, read_any_ = false, sent_any_ = false;
  Time since_{};  // `taken` of what is held, or the first read
  Time sent_{};
};

}  // namespace limpid
