// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/environment/environment.hpp>

#include <Eigen/Core>

#include <cmath>

namespace limpid {

/// Tissue whose stiffness grows with its force, as Fung's, with a damper beside it:
///
///     F_e = A (exp(r x) - 1) + b v
///     theta = (A, b),     phi = (exp(r x) - 1, v)
///
/// A in N, b in N s/m; the stiffness at the surface is A r. From r x = 64 on, where the exponential is 6e27, the force
/// goes on along its tangent, so that it is finite at any depth.
/// @tparam Axes  number of axes
/// @realtime     no allocation, no throw; an exponential an axis
template <int Axes = 1, Real Scalar_ = double>
class Exponential {
 public:
  using Scalar = Scalar_;
  static constexpr int axes = Axes;
  static constexpr int parameters = 2;
  static constexpr bool linear = false;

  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Theta = Eigen::Array<Scalar, Axes, parameters>;  // columns A, b

  struct Settings {
    Scalar growth{};  ///< r, of the stiffness over depth, 1/m, > 0
  };

  /// @throws std::invalid_argument  where the growth is not positive and finite
  explicit Exponential(const Settings& settings) : growth_{settings.growth} {
    expect(is_finite(growth_) && growth_ > Scalar{0}, "Exponential: growth", "finite and > 0", growth_);
  }

  [[nodiscard]] Theta regressor(const Vector& x, const Vector& v) const noexcept {
    const Vector rise = risen(x);
    Theta phi;
    phi << rise + (rise + Scalar{1}) * beyond(x), v;
    return phi;
  }

  [[nodiscard]] Vector force(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return response(theta, x, v).force;
  }

  [[nodiscard]] Tangents<Axes, Scalar> tangent(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return response(theta, x, v).tangent;
  }

  /// From one exponential.
  [[nodiscard]] ForceAndTangent<Axes, Scalar> response(const Theta& theta, const Vector& x,
                                                       const Vector& v) const noexcept {
    const auto A = theta.col(0), b = theta.col(1);
    const Vector rise = risen(x), slope = rise + Scalar{1};
    return {A * (rise + slope * beyond(x)) + b * v, {A * (slope * growth_), b}};
  }

 private:
  static constexpr int last = 64;  // of r x; beyond it the tangent

  // exp(r x) - 1, without cancelling near the surface
  [[nodiscard]] Vector risen(const Vector& x) const noexcept {
    using std::expm1;
    Vector rise;
    for (int axis = 0; axis < Axes; ++axis) {
      const Scalar part = growth_ * x[axis];
      rise[axis] = expm1(part < Scalar(last) ? part : Scalar(last));
    }
    return rise;
  }

  // r x - 64, where that is positive
  [[nodiscard]] Vector beyond(const Vector& x) const noexcept { return (growth_ * x - Scalar(last)).max(Scalar{0}); }

  Scalar growth_;  // r
};

}  // namespace limpid
