// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>

#include <Eigen/Core>

namespace limpid {

/// Rounds each axis to the nearest multiple of its step, halves away from zero: an encoder, a converter.
/// @tparam Axes  number of independent axes
/// @realtime     no allocation, no throw; a division, a rounding and a product an axis
template <int Axes = 1, Real Scalar = double>
class Quantiser {
 public:
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  struct Settings {
    Vector step = Vector::Zero();  ///< between two levels, in the signal's unit; > 0
  };

  struct Output {
    Vector value;   ///< in the signal's unit; always finite
    Status status;  ///< `not_finite` where an axis kept its last good value
  };

  /// @throws std::invalid_argument  where a step is not positive and finite
  explicit Quantiser(const Settings& settings) : step_{settings.step} {
    expect(is_finite(step_) && (step_ > Scalar{0}).all(), "Quantiser: step", "finite and > 0", step_);
  }

  /// The level nearest to `u`; `u` itself where its level is beyond the scalar's range.
  [[nodiscard]] Output update(const Vector& u) noexcept {
    Status status = Status::ok;
    for (int axis = 0; axis < Axes; ++axis) {
      if (!is_finite(u[axis])) {
        status |= Status::not_finite;
        continue;
      }
      using std::round;
      const Scalar level = step_[axis] * round(Scalar(u[axis] / step_[axis]));
      last_[axis] = is_finite(level) ? level : u[axis];
    }
    return {last_, status};
  }

 private:
  Vector step_;
  Vector last_ = Vector::Zero();  // last good output
};

}  // namespace limpid
