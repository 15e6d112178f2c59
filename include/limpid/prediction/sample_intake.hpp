// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/prediction/predictor.hpp>

#include <algorithm>

namespace limpid::detail {

/// Keeps the laws of a predictor on its inputs: which ticks there are, and which sample holds in each.
/// @realtime  no allocation, no throw; copies
template <int Axes, Real Scalar>
class SampleIntake {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  /// @return  not_finite, clock_backwards (taken after it arrived), out_of_order: the sample was dropped
  [[nodiscard]] Status observe(const ToolSample<Axes, Scalar>& sample) noexcept {
    if (!is_finite(sample.value)) return Status::not_finite;
    if (sample.taken > sample.arrived) return Status::clock_backwards;
    if (stamps_.seen(sample.taken)) return Status::out_of_order;
    next_ = sample.value;
    stamps_.observe(sample.taken);
    return Status::ok;
  }

  /// Why there is no tick at `now`, or ok.
  [[nodiscard]] Status refusal(Time now, const Vector& F_h) const noexcept {
    return when(started_ && now <= now_, Status::clock_backwards) | when(!is_finite(F_h), Status::not_finite);
  }

  /// Begins a tick that was not refused: the sample observed for it holds from now on.
  /// @return  no_sample, out_of_history (a sample taken after `now` was dropped)
  [[nodiscard]] Status begin(Time now) noexcept {
    started_ = true;
    now_ = now;
    fresh_ = false;
    Status status = Status::ok;
    if (stamps_.pending()) {
      status = stamps_.settle(now);
      fresh_ = status == Status::ok;
      if (fresh_) held_ = next_;
    }
    return status | when(!stamps_.any(), Status::no_sample);
  }

  // In a tick, between `begin` and the next `observe`.
  [[nodiscard]] bool any() const noexcept { return stamps_.any(); }
  [[nodiscard]] bool fresh() const noexcept { return fresh_; }  ///< whether the sample is new in this tick
  [[nodiscard]] const ToolState<Axes, Scalar>& held() const noexcept { return held_; }
  [[nodiscard]] Time taken() const noexcept { return stamps_.taken(); }
  /// Of the sample, s; no more than `most`.
  [[nodiscard]] Scalar age(Duration most) const noexcept {
    return in_seconds<Scalar>(std::min(elapsed(now_, stamps_.taken()), most));
  }

 private:
  ToolState<Axes, Scalar> held_{}, next_{};  // of the last tick, observed since
  SampleStamps stamps_;
  bool started_ = false, fresh_ = false;
  Time now_{};
};

}  // namespace limpid::detail
