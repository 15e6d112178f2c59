// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/environment/environment.hpp>

#include <Eigen/Core>

namespace limpid {

/// Tissue that stiffens smoothly at a depth x_s, eq. (3.34), with a damper beside it:
///
///     F_e = k1 (x - s) + k2 s + b v,     s(x) = (x_s / R) ln(1 + exp(R (x/x_s - 1)))
///     theta = (k1, k2, b),     phi = (x - s, s, v)
///
/// k1, k2 in N/m, b in N s/m. s is the softened part of the depth beyond x_s; the logarithm is taken of exp(-|.|),
/// which neither overflows nor cancels at any depth.
/// @tparam Axes  number of axes
/// @realtime     no allocation, no throw; an exponential and a logarithm an axis
template <int Axes = 1, Real Scalar_ = double>
class SmoothBilinear {
 public:
  using Scalar = Scalar_;
  static constexpr int axes = Axes;
  static constexpr int parameters = 3;
  static constexpr bool linear = false;

  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Theta = Eigen::Array<Scalar, Axes, parameters>;  // columns k1, k2, b

  struct Settings {
    Scalar depth{};      ///< x_s, where the stiffness changes, m, > 0
    Scalar sharpness{};  ///< R, of the change, > 0
  };

  /// @throws std::invalid_argument  where a setting is not positive and finite
  explicit SmoothBilinear(const Settings& settings) : depth_{settings.depth}, sharpness_{settings.sharpness} {
    expect(is_finite(depth_) && depth_ > Scalar{0}, "SmoothBilinear: depth", "finite and > 0", depth_);
    expect(is_finite(sharpness_) && sharpness_ > Scalar{0}, "SmoothBilinear: sharpness", "finite and > 0", sharpness_);
  }

  [[nodiscard]] Theta regressor(const Vector& x, const Vector& v) const noexcept {
    const Vector round = rounding(x);
    Theta phi;
    phi << x.min(depth_) - round, (x - depth_).max(Scalar{0}) + round, v;
    return phi;
  }

  [[nodiscard]] Vector force(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return (theta * regressor(x, v)).rowwise().sum();
  }

  [[nodiscard]] Tangents<Axes, Scalar> tangent(const Theta& theta, const Vector& x, const Vector&) const noexcept {
    const Vector away = distance(x);
    const Vector small = exp_minus(away.abs());                                                    // at most 1
    const Vector beyond = (away > Scalar{0}).select(Vector::Ones(), small) / (Scalar{1} + small);  // ds/dx
    return {theta.col(0) * (Scalar{1} - beyond) + theta.col(1) * beyond, theta.col(2)};
  }

 private:
  // R (x/x_s - 1); from the difference, which is exact near x_s
  [[nodiscard]] Vector distance(const Vector& x) const noexcept { return sharpness_ * ((x - depth_) / depth_); }

  // What the soft corner adds to the sharp one: (x_s / R) ln(1 + exp(-|R (x/x_s - 1)|))
  [[nodiscard]] Vector rounding(const Vector& x) const noexcept {
    return (depth_ / sharpness_) * exp_minus(distance(x).abs()).unaryExpr([](const Scalar& small) {
      using std::log1p;
      return Scalar(log1p(small));
    });
  }

  [[nodiscard]] static Vector exp_minus(const Vector& y) noexcept {
    return y.unaryExpr([](const Scalar& entry) {
      using std::exp;
      return Scalar(exp(-entry));
    });
  }

  Scalar depth_;
  Scalar sharpness_;
};

}  // namespace limpid
