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
#include <limpid/signal/history.hpp>

#include <cstddef>

namespace limpid {

/// Quadratic extrapolation of the newest sample over its age t, x + v t + a t^2/2 and v + a t, with the tool's
/// acceleration as the sampled force F_e and the operator's remembered one make it at the sample's instant, (3.29):
///
///     a = (F_h(taken) - F_e - b_t v - k_t (x - anchor)) / m_t
///
/// Exact while the acceleration does not change.
/// @tparam Capacity  ticks of the operator's force remembered, a power of two
/// @realtime         no allocation, no throw; a search in the history for each new sample, and 5 flops an axis
template <int Axes = 1, Real Scalar_ = double, std::size_t Capacity = 512>
class QuadraticPredictor {
 public:
  using Scalar = Scalar_;
  static constexpr int axes = Axes;
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  struct Settings {
    Tool<Axes, Scalar> tool{};                          ///< kg, N s/m, N/m
    Motion<Axes, Scalar> start{};                       ///< held until the first sample; m, m/s, m/s^2
    Duration horizon = std::chrono::milliseconds{500};  ///< an older sample's motion is held at this age; >= 0
  };

  /// @throws std::invalid_argument  where the tool is refused, the start not finite or the horizon negative
  explicit QuadraticPredictor(const Settings& settings)
      : tool_{settings.tool}, motion_{settings.start}, horizon_{settings.horizon} {
    tool_.check();
    expect(is_finite(motion_), "QuadraticPredictor: start", "finite", "a motion that is not");
    expect(horizon_ >= Duration{0}, "QuadraticPredictor: horizon", ">= 0", horizon_);
  }

  /// Takes in a sample that has arrived; it holds from the next `advance` on.
  /// @return  not_finite, clock_backwards (taken after it arrived), out_of_order: the sample was dropped
  [[nodiscard]] Status observe(const ToolSample<Axes, Scalar>& sample) noexcept { return intake_.observe(sample); }

  /// @param F_h  operator's force at `now`, N
  /// @return     out_of_history: a sample taken after `now` was dropped, or F_h at its instant is not remembered and
  ///             the nearest one was used; not_finite: what came out is not, and the last motion was returned
  [[nodiscard]] Prediction<Axes, Scalar> advance(Time now, const Vector& F_h) noexcept {
    if (const Status refused = intake_.refusal(now, F_h); refused != Status::ok) return {motion_, refused};
    Status status = intake_.begin(now);
    forces_.append(now, F_h);
    if (intake_.fresh()) status |= take_acceleration();
    if (!intake_.any()) return {motion_, status};
    const auto& s = intake_.held();
    const Scalar t = intake_.age(horizon_);
    const Motion<Axes, Scalar> next{s.x + (s.v + a_ * (t / Scalar{2})) * t, s.v + a_ * t, a_};
    if (!is_finite(next)) return {motion_, status | Status::not_finite};
    motion_ = next;
    return {motion_, status};
  }

 private:
  Status take_acceleration() noexcept {
    const auto [F_h, status] = forces_.at(intake_.taken());
    const auto& s = intake_.held();
    a_ = (F_h - s.force - tool_.damping * s.v - tool_.stiffness * (s.x - tool_.anchor)) / tool_.mass;
    return status;
  }

  Tool<Axes, Scalar> tool_;
  Motion<Axes, Scalar> motion_;  // returned last
  Duration horizon_{};
  Vector a_ = Vector::Zero();  // at the sample, m/s^2
  detail::SampleIntake<Axes, Scalar> intake_;
  History<Vector, Capacity> forces_;
};

}  // namespace limpid
