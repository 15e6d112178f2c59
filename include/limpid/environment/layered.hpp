// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/environment/environment.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace limpid {

/// Tissue in layers, each with a stiffness of its own, with a damper beside them:
///
///     F_e = sum_i k_i x_i + b v,     x_1 + ... + x_n = x
///     theta = (k_1, ..., k_n, b),     phi = (x_1, ..., x_n, v)
///
/// x_i is the part of the depth within layer i, which reaches from d_(i-1) to d_i: the first from any height, the last
/// to any depth. k_i in N/m, b in N s/m. The force is continuous; at a depth d_i the stiffness is that of the layer
/// below.
/// @tparam Layers  n, at least 2
/// @tparam Axes    number of axes, all with the same depths
/// @realtime       no allocation, no throw; 4 flops a layer and axis
template <int Layers = 3, int Axes = 1, Real Scalar_ = double>
class Layered {
  static_assert(Layers >= 2, "Layered: at least two layers");

 public:
  using Scalar = Scalar_;
  static constexpr int axes = Axes;
  static constexpr int parameters = Layers + 1;
  static constexpr bool linear = false;

  using Vector = Eigen::Array<Scalar, Axes, 1>;
  using Theta = Eigen::Array<Scalar, Axes, parameters>;  // columns k_1 to k_n, b

  struct Settings {
    std::array<Scalar, std::size_t{Layers} - 1> depths{};  ///< d_1 to d_(n-1), m, > 0, each greater than the last
  };

  /// @throws std::invalid_argument  where the depths are not positive, finite and ascending
  explicit Layered(const Settings& settings) : depths_{settings.depths} {
    Scalar above{0};
    for (const Scalar& depth : depths_) {
      expect(is_finite(depth) && depth > above, "Layered: depths", "finite, > 0 and ascending", depth);
      above = depth;
    }
  }

  [[nodiscard]] Theta regressor(const Vector& x, const Vector& v) const noexcept {
    Theta phi;
    for (int i = 0; i < Layers; ++i) phi.col(i) = within(i, x);
    phi.col(Layers) = v;
    return phi;
  }

  [[nodiscard]] Vector force(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    Vector sum = theta.col(Layers) * v;
    for (int i = 0; i < Layers; ++i) sum += theta.col(i) * within(i, x);
    return sum;
  }

  [[nodiscard]] Tangents<Axes, Scalar> tangent(const Theta& theta, const Vector& x, const Vector&) const noexcept {
    Vector stiffness = theta.col(0);
    for (int i = 1; i < Layers; ++i) stiffness = (x >= top(i)).select(theta.col(i), stiffness);
    return {stiffness, theta.col(Layers)};
  }

 private:
  // Where a layer but the first begins, m.
  [[nodiscard]] const Scalar& top(int layer) const noexcept { return depths_[static_cast<std::size_t>(layer - 1)]; }

  // The part of the depth within a layer.
  [[nodiscard]] Vector within(int layer, const Vector& x) const noexcept {
    Vector part = x;
    if (layer < Layers - 1) part = x.min(top(layer + 1));
    return layer > 0 ? Vector((part - top(layer)).max(Scalar{0})) : part;
  }

  std::array<Scalar, std::size_t{Layers} - 1> depths_;
};

}  // namespace limpid
