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
  [[nodiscard]] Status observe(const ToolSample<Axes, Scalar>& sample) noexcept { return intake_.observe(sample); }

  /// @param F_h  operator's force, N; has no influence
  /// @return     out_of_history: a sample taken after `now` was dropped
  [[nodiscard]] Prediction<Axes, Scalar> advance(Time now, const Vector& F_h) noexcept {
    if (const Status refused = intake_.refusal(now, F_h); refused != Status::ok) return {held_, refused};
    const Status status = intake_.begin(now);
    if (intake_.fresh()) held_ = {intake_.held().x, intake_.held().v, intake_.held().a};
    return {held_, status};
  }

 private:
  Motion<Axes, Scalar> held_{};  // returned last
  detail::SampleIntake<Axes, Scalar> intake_;
};

}  // namespace limpid
