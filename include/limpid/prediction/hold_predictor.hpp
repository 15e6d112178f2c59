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

  Status observe(const ToolSample<Axes, Scalar>& sample) noexcept {
    if (!is_finite(sample.value)) return Status::not_finite;
    if (sampled_ && sample.taken <= taken_) return Status::out_of_order;
    held_ = {sample.value.x, sample.value.v, sample.value.a};
    taken_ = sample.taken;
    sampled_ = true;
    return Status::ok;
  }

  /// @param F_h  operator's force, N; has no influence
  Prediction<Axes, Scalar> advance(Time now, const Vector& F_h) noexcept {
    const bool late = started_ && now <= now_;
    const bool finite = is_finite(F_h);
    if (late || !finite) return {last_, when(late, Status::clock_backwards) | when(!finite, Status::not_finite)};
    now_ = now;
    started_ = true;
    last_ = held_;
    return {last_, when(!sampled_, Status::no_sample)};
  }

 private:
  Motion<Axes, Scalar> held_{}, last_ = held_;  // of the newest sample; returned last
  bool started_ = false, sampled_ = false;
  Time now_{}, taken_{};
};

}  // namespace limpid
