// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/environment/environment.hpp>

#include <Eigen/Core>

namespace limpid {

/// Linear environment with cross-coupling, eq. (3.30) with constant matrices:
///
///     F_e = K x + B v,     row i of theta = (row i of K, row i of B),     every row of phi = (x', v')
///
/// K in N/m, B in N s/m. As far as the concept carries it: `tangent` gives the diagonals of K and B, which are not all
/// there is to know (`decoupled` is false).
/// @tparam Axes  number of axes
/// @realtime     no allocation, no throw; 4 Axes flops an axis
template <int Axes = 1, Real Scalar_ = double>
class Coupled {
 public:
  using Scalar = Scalar_;
  static constexpr int axes = Axes;
  static constexpr int parameters = 2 * Axes;
  static constexpr bool linear = true;
  static constexpr bool decoupled = Axes == 1;

  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Theta = Eigen::Array<Scalar, Axes, parameters>;  // K beside B

  [[nodiscard]] Theta regressor(const Vector& x, const Vector& v) const noexcept {
    Theta phi;
    phi << x.transpose().template replicate<Axes, 1>(), v.transpose().template replicate<Axes, 1>();
    return phi;
  }

  [[nodiscard]] Vector force(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return theta.template leftCols<Axes>().matrix() * x.matrix() +
           theta.template rightCols<Axes>().matrix() * v.matrix();
  }

  [[nodiscard]] Tangents<Axes, Scalar> tangent(const Theta& theta, const Vector&, const Vector&) const noexcept {
    return {theta.template leftCols<Axes>().matrix().diagonal(), theta.template rightCols<Axes>().matrix().diagonal()};
  }
};

}  // namespace limpid
