// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/lane_power.hpp>
#include <limpid/core/lane_select.hpp>
#include <limpid/core/real.hpp>
#include <limpid/environment/environment.hpp>

#include <Eigen/Core>

namespace limpid {

/// Contact of Hunt and Crossley on each axis, with a damper beside it (thesis section 7.1.2):
///
///     F_e = k |x|^N sign(x) + lambda |x|^N v + b v
///     theta = (k, lambda, b),     phi = (|x|^N sign(x), |x|^N v, v)
///
/// k in N/m^N, lambda in N s/m^(N+1), b in N s/m. The derivative of |x| at 0 is taken as 0.
/// @tparam Axes  number of axes
/// @realtime     no allocation, no throw; a power an axis
template <int Axes = 1, Real Scalar_ = double>
class HuntCrossley {
 public:
  using Scalar = Scalar_;
  static constexpr int axes = Axes;
  static constexpr int parameters = 3;
  static constexpr bool linear = false;

  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Theta = Eigen::Array<Scalar, Axes, parameters>;  // columns k, lambda, b

  struct Settings {
    Scalar exponent{};  ///< N, >= 1
  };

  /// @throws std::invalid_argument  where the exponent is below one or not finite
  explicit HuntCrossley(const Settings& settings) : exponent_{settings.exponent} {
    expect(is_finite(exponent_) && exponent_ >= Scalar{1}, "HuntCrossley: exponent", "finite and >= 1", exponent_);
  }

  [[nodiscard]] Theta regressor(const Vector& x, const Vector& v) const noexcept {
    const Vector depth = x.abs(), slope = power(depth, Scalar(exponent_ - Scalar{1}));
    Theta phi;
    phi << slope * x, slope * depth * v, v;
    return phi;
  }

  [[nodiscard]] Vector force(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return response(theta, x, v).force;
  }

  [[nodiscard]] Tangents<Axes, Scalar> tangent(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return response(theta, x, v).tangent;
  }

  /// From one power |x|^(N - 1).
  [[nodiscard]] ForceAndTangent<Axes, Scalar> response(const Theta& theta, const Vector& x,
                                                       const Vector& v) const noexcept {
    const auto k = theta.col(0), lambda = theta.col(1), b = theta.col(2);
    const Vector depth = x.abs(), slope = power(depth, Scalar(exponent_ - Scalar{1}));
    const Vector damping = lambda * slope * depth + b;
    return {k * slope * x + damping * v, {exponent_ * slope * (k + lambda * approach(x, v)), damping}};
  }

 private:
  // sign(x) v
  static Vector approach(const Vector& x, const Vector& v) noexcept {
    const Vector none = Vector::Zero();
    return where_positive(x, v, where_positive(Vector(-x), Vector(-v), none));
  }

  Scalar exponent_;
};

}  // namespace limpid
