// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/environment/environment.hpp>

#include <Eigen/Core>

namespace limpid {

/// An environment that touches from one side: no force outside the wall (x <= 0), and never a pull. The thesis keeps
/// contact bilateral (section 3.1); this is for a scene that asks otherwise.
///
///     F = max(F_E, 0)  for x > 0,      F = 0  otherwise,       each axis for itself
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
    const Vector pressing = Traits::force(environment_, theta, x, v).max(Scalar{0});
    return (x > Scalar{0}).select(pressing, Vector::Zero());
  }

  [[nodiscard]] Tangents<axes, Scalar> tangent(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    const Tangents<axes, Scalar> inner = Traits::tangent(environment_, theta, x, v);
    const Vector pressing = force(theta, x, v);
    return {(pressing > Scalar{0}).select(inner.stiffness, Vector::Zero()),
            (pressing > Scalar{0}).select(inner.damping, Vector::Zero())};
  }

 private:
  E environment_;
};

}  // namespace limpid
