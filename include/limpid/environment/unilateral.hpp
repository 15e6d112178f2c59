// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/lane_select.hpp>
#include <limpid/environment/environment.hpp>

#include <Eigen/Core>

namespace limpid {

/// An environment that touches from one side: no force outside the wall (x <= 0), and never a pull. The thesis keeps
/// contact bilateral (section 3.1); this is for a scene that asks otherwise.
///
///     F = max(F_E, 0)  for x > 0,      F = 0  otherwise,       each axis for itself
///
/// A predictor's constant gain that was designed for contact may be unstable outside, where neither stiffness nor
/// damping holds the tool: see `ModelPredictor`.
///
/// Where it would pull the force is not phi' theta (`bilateral` is false): an estimator must not learn from such a
/// sample.
/// @tparam E  an environment whose axes do not feel each other
/// @realtime  as E, no allocation, no throw
template <DecoupledEnvironment E>
class Unilateral {
  using Traits = EnvironmentTraits<E>;

 public:
  using Scalar = typename Traits::Scalar;
  static constexpr int axes = Traits::axes;
  static constexpr int parameters = Traits::parameters;
  static constexpr bool linear = false;
  static constexpr bool bilateral = false;

  using Vector = EnvironmentVector<E>;
  using Theta = EnvironmentTheta<E>;

  struct Settings {
    E environment{};
  };

  explicit Unilateral(const Settings& settings) : environment_{settings.environment} {}

  [[nodiscard]] Theta regressor(const Vector& x, const Vector& v) const noexcept {
    const auto inside = (x > Scalar{0}).template replicate<1, parameters>();
    return inside.select(Traits::regressor(environment_, x, v), Theta::Zero());
  }

  [[nodiscard]] Vector force(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return pressing(x, Traits::force(environment_, theta, x, v));
  }

  [[nodiscard]] Tangents<axes, Scalar> tangent(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return response(theta, x, v).tangent;
  }

  /// From one response of E.
  [[nodiscard]] ForceAndTangent<axes, Scalar> response(const Theta& theta, const Vector& x,
                                                       const Vector& v) const noexcept {
    const auto [force, slopes] = response_of(environment_, theta, x, v);
    const Vector here = pressing(x, force);
    return {here, {where_positive(here, slopes.stiffness, none()), where_positive(here, slopes.damping, none())}};
  }

 private:
  static Vector none() noexcept { return Vector::Zero(); }

  // The force of E but for a pull, inside the wall.
  static Vector pressing(const Vector& x, const Vector& force) noexcept {
    return where_positive(x, where_positive(Vector(-force), none(), force), none());
  }

  E environment_;
};

}  // namespace limpid
