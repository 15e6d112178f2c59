// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/lane_exponential.hpp>
#include <limpid/core/lane_select.hpp>
#include <limpid/core/lanes.hpp>
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
  explicit SmoothBilinear(const Settings& settings)
      : depth_{settings.depth},
        steepness_{settings.sharpness / settings.depth},
        width_{settings.depth / settings.sharpness} {
    const auto& [depth, sharpness] = settings;
    expect(is_finite(depth) && depth > Scalar{0}, "SmoothBilinear: depth", "finite and > 0", depth);
    expect(is_finite(sharpness) && sharpness > Scalar{0}, "SmoothBilinear: sharpness", "finite and > 0", sharpness);
  }

  [[nodiscard]] Theta regressor(const Vector& position, const Vector& v) const noexcept {
    const Array x = to_lanes<Axes>(position), round = rounding(small(distance(x)));
    Theta phi;
    phi << before(x, round).template head<Axes>(), beyond(x, round).template head<Axes>(), v;
    return phi;
  }

  [[nodiscard]] Vector force(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return response(theta, x, v).force;
  }

  [[nodiscard]] Tangents<Axes, Scalar> tangent(const Theta& theta, const Vector& x, const Vector&) const noexcept {
    const Array away = distance(to_lanes<Axes>(x));
    return {stiffness(theta, away, small(away)).template head<Axes>(), theta.col(2)};
  }

  /// From one exponential.
  [[nodiscard]] ForceAndTangent<Axes, Scalar> response(const Theta& theta, const Vector& position,
                                                       const Vector& velocity) const noexcept {
    const Array x = to_lanes<Axes>(position), v = to_lanes<Axes>(velocity);
    const Array k1 = to_lanes<Axes>(theta.col(0)), k2 = to_lanes<Axes>(theta.col(1)), b = to_lanes<Axes>(theta.col(2));
    const Array away = distance(x), tail = small(away), round = rounding(tail);
    return {(k1 * before(x, round) + k2 * beyond(x, round) + b * v).template head<Axes>(),
            {stiffness(theta, away, tail).template head<Axes>(), theta.col(2)}};
  }

 private:
  using Array = Lanes<Axes, Scalar>;

  // R (x/x_s - 1); from the difference, which is exact near x_s
  [[nodiscard]] Array distance(const Array& x) const noexcept { return steepness_ * (x - depth_); }

  // exp(-|R (x/x_s - 1)|), at most 1
  static Array small(const Array& away) noexcept { return exponential(Array(-away.abs())); }

  // What the soft corner adds to the sharp one: (x_s / R) ln(1 + exp(-|R (x/x_s - 1)|))
  [[nodiscard]] Array rounding(const Array& tail) const noexcept { return width_ * logarithm_of_one_plus(tail); }

  // x - s and s
  [[nodiscard]] Array before(const Array& x, const Array& round) const noexcept { return x.min(depth_) - round; }
  [[nodiscard]] Array beyond(const Array& x, const Array& round) const noexcept {
    return (x - depth_).max(Scalar{0}) + round;
  }

  // k1 (1 - ds/dx) + k2 ds/dx
  [[nodiscard]] static Array stiffness(const Theta& theta, const Array& away, const Array& tail) noexcept {
    const Array k1 = to_lanes<Axes>(theta.col(0)), k2 = to_lanes<Axes>(theta.col(1)), one = Array::Ones();
    const Array part = where_positive(away, one, tail) / (one + tail);
    return k1 * (one - part) + k2 * part;
  }

  Scalar depth_;
  Scalar steepness_, width_;  // R / x_s, x_s / R
};

}  // namespace limpid
