// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/environment/environment.hpp>

#include <Eigen/Core>

namespace limpid {

/// Tangent to a nonlinear force: spring, damper and offset on each axis, eq. (3.33):
///
///     F_e = k x + b v + c,     theta = (k, b, c),     phi = (x, v, 1)
///
/// k in N/m, b in N s/m, c in N.
/// @tparam Axes  number of axes
/// @realtime     no allocation, no throw; 4 flops an axis
template <int Axes = 1, Real Scalar_ = double>
class Tangent {
 public:
  using Scalar = Scalar_;
  static constexpr int axes = Axes;
  static constexpr int parameters = 3;
  static constexpr bool linear = true;

  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Theta = Eigen::Array<Scalar, Axes, parameters>;  // columns k, b, c

  [[nodiscard]] Theta regressor(const Vector& x, const Vector& v) const noexcept {
    Theta phi;
    phi << x, v, Vector::Ones();
    return phi;
  }

  [[nodiscard]] Vector force(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return theta.col(0) * x + theta.col(1) * v + theta.col(2);
  }

  [[nodiscard]] Tangents<Axes, Scalar> tangent(const Theta& theta, const Vector&, const Vector&) const noexcept {
    return {theta.col(0), theta.col(1)};
  }
};

}  // namespace limpid
