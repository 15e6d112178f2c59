// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <limpid/environment/environment.hpp>

#include <functional>
#include <utility>

namespace limpid::examples {

/// A tissue of any kind as one environment, so that what works with environments is compiled once for all kinds. Its
/// one parameter scales the force.
class TissueModel {
 public:
  using Scalar = double;
  static constexpr int axes = 1;
  static constexpr int parameters = 1;
  static constexpr bool linear = false;

  using Vector = Eigen::Array<double, 1, 1>;
  using Theta = Vector;
  using Response = std::function<ForceAndTangent<1>(const Vector& x, const Vector& v)>;

  TissueModel() = default;
  explicit TissueModel(Response response) : response_{std::move(response)} {}

  [[nodiscard]] Theta regressor(const Vector& x, const Vector& v) const noexcept { return response_(x, v).force; }

  [[nodiscard]] Vector force(const Theta& scale, const Vector& x, const Vector& v) const noexcept {
    return scale * response_(x, v).force;
  }

  [[nodiscard]] Tangents<1> tangent(const Theta& scale, const Vector& x, const Vector& v) const noexcept {
    return response(scale, x, v).tangent;
  }

  [[nodiscard]] ForceAndTangent<1> response(const Theta& scale, const Vector& x, const Vector& v) const noexcept {
    const auto [force, slopes] = response_(x, v);
    return {scale * force, {scale * slopes.stiffness, scale * slopes.damping}};
  }

 private:
  Response response_;
};

/// Whether the force is k x + b v everywhere.
[[nodiscard]] bool is_linear(const Tissue& tissue);

/// The tissue, undisturbed, whatever its kind.
[[nodiscard]] TissueModel model_of(const Tissue& tissue);

/// Its parts, for a tool in a tissue that is disturbed.
[[nodiscard]] UndisturbedForce undisturbed_force(const Tissue& tissue);

}  // namespace limpid::examples
