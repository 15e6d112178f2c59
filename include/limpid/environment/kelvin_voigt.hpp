// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/environment/environment.hpp>

#include <Eigen/Core>

namespace limpid {

/// Spring and damper side by side on each axis, eqs. (3.31), (3.32):
///
///     F_e = k x + b v,     theta = (k, b),     phi = (x, v)
///
/// k in N/m, b in N s/m.
/// @tparam Axes  number of axes
/// @realtime     no allocation, no throw; 3 flops an axis
template <int Axes = 1, Real Scalar_ = double>
class KelvinVoigt {
 public:
  using Scalar = Scalar_;
  static constexpr int axes = Axes;
  static constexpr int parameters = 2;
  static constexpr bool linear = true;

  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Theta = Eigen::Array<Scalar, Axes, parameters>;  // columns k, b

  [[nodiscard]] Theta regressor(const Vector& x, const Vector& v) const noexcept {
    Theta phi;
    phi << x, v;
    return phi;
  }

  [[nodiscard]] Vector force(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return theta.col(0) * x + theta.col(1) * v;
  }

  [[nodiscard]] Tangents<Axes, Scalar> tangent(const Theta& theta, const Vector&, const Vector&) const noexcept {
    return {theta.col(0), theta.col(1)};
  }
};

}  // namespace limpid
