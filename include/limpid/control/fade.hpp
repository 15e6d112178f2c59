// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/time.hpp>

namespace limpid {

/// A factor from 0 to 1 for a force whose source may fail: it goes to zero while the source is not healthy, and comes
/// back once that has been healthy for a while.
///
///     out   from where it is, straight, at 1/fade_out: zero within fade_out of the last healthy call
///     in    f0 + (1 - f0) (3 u^2 - 2 u^3), u from 0 to 1 in fade_in, from where it is, f0, when the source has been
///           healthy for `hold`; it begins and ends without slope
///
/// So between two calls dt apart it falls by dt/fade_out at most, and rises by 3/2 dt/fade_in at most. Until the source
/// has been healthy for `hold` the factor goes on falling. It begins at zero.
///
/// For the wanted torque, before the SafetyLimiter, which does not then hear of the source's status: to it `stale` is a
/// fault.
/// @realtime  update: no allocation, no throw
template <Real Scalar = double>
class Fade {
 public:
  struct Settings {
    Duration fade_out{};  ///< from 1 to 0, > 0
    Duration fade_in{};   ///< to 1, > 0
    Duration hold{};      ///< healthy calls before the way back, >= 0
  };

  /// @throws std::invalid_argument  where a setting cannot serve
  explicit Fade(const Settings& settings) : settings_{settings} {
    expect(settings.fade_out > Duration::zero(), "Fade: fade_out", "> 0 s", settings.fade_out);
    expect(settings.fade_in > Duration::zero(), "Fade: fade_in", "> 0 s", settings.fade_in);
    expect(settings.hold >= Duration::zero(), "Fade: hold", ">= 0 s", settings.hold);
  }

  /// At `now`. Where time does not advance nothing changes.
  [[nodiscard]] Scalar update(Time now, bool healthy) noexcept {
    if (started_ && now <= now_) return factor_;
    if (!started_) turn(now, false);
    if (!healthy) {
      if (rises_) turn(now_, false);
      well_ = false;
    } else if (!well_) {
      well_ = true;
      well_since_ = now;
    }
    if (well_ && !rises_ && elapsed(now, well_since_) >= settings_.hold) {
      factor_ = fallen(now);
      turn(now, true);
    }
    started_ = true;
    now_ = now;
    return factor_ = rises_ ? risen(now) : fallen(now);
  }

  /// As the last call returned it.
  [[nodiscard]] Scalar factor() const noexcept { return factor_; }

 private:
  void turn(Time at, bool rises) noexcept {
    from_ = factor_;
    since_ = at;
    rises_ = rises;
  }

  [[nodiscard]] static Scalar part(Duration way, Duration whole) noexcept {
    return way >= whole ? Scalar(1) : static_cast<Scalar>(way.count()) / static_cast<Scalar>(whole.count());
  }

  [[nodiscard]] Scalar fallen(Time now) const noexcept {
    const Scalar fall = part(elapsed(now, since_), settings_.fade_out);
    return from_ > fall ? Scalar(from_ - fall) : Scalar(0);
  }
  [[nodiscard]] Scalar risen(Time now) const noexcept {
    const Scalar u = part(elapsed(now, since_), settings_.fade_in);
    return from_ + (Scalar(1) - from_) * (u * u * (Scalar(3) - Scalar(2) * u));
  }

  Settings settings_;
  Scalar factor_{0}, from_{0};  // now, and where it turned
  bool started_ = false, rises_ = false, well_ = false;
  Time now_{}, since_{}, well_since_{};
};

}  // namespace limpid
