// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/prediction/predictor.hpp>

namespace limpid {

/// No prediction: the newest sample, held; x_e,zd of thesis section 4.3.2 and the comparison of (3.38).
/// @realtime  no allocation, no throw; copies
template <int Axes = 1, Real Scalar_ = double>
class HoldPredictor {
 public:
  using Scalar = Scalar_;
  static constexpr int axes = Axes;
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  struct Settings {
    Motion<Axes, Scalar> start{};  ///< held until the first sample; m, m/s, m/s^2
  };

  HoldPredictor() = default;

  /// @throws std::invalid_argument  where the start is not finite
  explicit HoldPredictor(const Settings& settings) : held_{settings.start} {
    expect(is_finite(held_), "HoldPredictor: start", "finite", "a motion that is not");
  }

  /// Takes in a sample that has arrived; it holds from the next `advance` on.
  /// @return  not_finite, clock_backwards (taken after it arrived), out_of_order: the sample was dropped
  [[nodiscard]] Status observe(const ToolSample<Axes, Scalar>& sample) noexcept {
    if (!is_finite(sample.value)) return Status::not_finite;
    if (sample.taken > sample.arrived) return Status::clock_backwards;
    if (newest_.seen(sample.taken)) return Status::out_of_order;
    next_ = {sample.value.x, sample.value.v, sample.value.a};
    newest_.observe(sample.taken);
    return Status::ok;
  }

  /// @param F_h  operator's force, N; has no influence
  /// @return     out_of_history: a sample taken after `now` was dropped
  [[nodiscard]] Prediction<Axes, Scalar> advance(Time now, const Vector& F_h) noexcept {
    const bool late = started_ && now <= now_;
    const bool finite = is_finite(F_h);
    if (late || !finite) return {held_, when(late, Status::clock_backwards) | when(!finite, Status::not_finite)};
    now_ = now;
    started_ = true;
    Status status = Status::ok;
    if (newest_.pending()) {
      status = newest_.settle(now);
      if (status == Status::ok) held_ = next_;
    }
    return {held_, status | when(!newest_.any(), Status::no_sample)};
  }

 private:
  Motion<Axes, Scalar> held_{}, next_{};  // returned last; of the sample observed since
  SampleStamps newest_;
  bool started_ = false;
  Time now_{};
};

}  // namespace limpid
