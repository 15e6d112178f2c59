// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/prediction/predictor.hpp>
#include <limpid/prediction/sample_intake.hpp>

namespace limpid {

/// Linear extrapolation of the newest sample over its age t: x + v t, v, without acceleration. Errs by a t^2/2.
/// @realtime  no allocation, no throw; 2 flops an axis
template <int Axes = 1, Real Scalar_ = double>
class LinearPredictor {
 public:
  using Scalar = Scalar_;
  static constexpr int axes = Axes;
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  struct Settings {
    Motion<Axes, Scalar> start{};                       ///< held until the first sample; m, m/s, m/s^2
    Duration horizon = std::chrono::milliseconds{500};  ///< an older sample's motion is held at this age; >= 0
  };

  LinearPredictor() : LinearPredictor(Settings{}) {}

  /// @throws std::invalid_argument  where the start is not finite or the horizon negative
  explicit LinearPredictor(const Settings& settings) : motion_{settings.start}, horizon_{settings.horizon} {
    expect(is_finite(motion_), "LinearPredictor: start", "finite", "a motion that is not");
    expect(horizon_ >= Duration{0}, "LinearPredictor: horizon", ">= 0", horizon_);
  }

  /// Takes in a sample that has arrived; it holds from the next `advance` on.
  /// @return  not_finite, clock_backwards (taken after it arrived), out_of_order: the sample was dropped
  [[nodiscard]] Status observe(const ToolSample<Axes, Scalar>& sample) noexcept { return intake_.observe(sample); }

  /// @param F_h  operator's force, N; has no influence
  /// @return     out_of_history: a sample taken after `now` was dropped; not_finite: what came out is not, and the last
  ///             motion was returned
  [[nodiscard]] Prediction<Axes, Scalar> advance(Time now, const Vector& F_h) noexcept {
    if (const Status refused = intake_.refusal(now, F_h); refused != Status::ok) return {motion_, refused};
    const Status status = intake_.begin(now);
    if (!intake_.any()) return {motion_, status};
    const auto& sample = intake_.held();
    const Motion<Axes, Scalar> next{sample.x + sample.v * intake_.age(horizon_), sample.v, Vector::Zero()};
    if (!is_finite(next)) return {motion_, status | Status::not_finite};
    motion_ = next;
    return {motion_, status};
  }

 private:
  Motion<Axes, Scalar> motion_{};  // returned last
  Duration horizon_{};
  detail::SampleIntake<Axes, Scalar> intake_;
};

}  // namespace limpid
