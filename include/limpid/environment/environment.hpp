// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <concepts>

namespace limpid {

/// Slopes of an environment's force at a point, each axis by its own position and velocity.
template <int Axes = 1, Real Scalar = double>
struct Tangents {
  using Vector = Eigen::Array<Scalar, Axes, 1>;

  Vector stiffness = Vector::Zero();  ///< dF/dx, N/m
  Vector damping = Vector::Zero();    ///< dF/dv, N s/m
};

/// An environment's force and its slopes at one point, found together.
template <int Axes = 1, Real Scalar = double>
struct ForceAndTangent {
  Eigen::Array<Scalar, Axes, 1> force = Eigen::Array<Scalar, Axes, 1>::Zero();  ///< N
  Tangents<Axes, Scalar> tangent{};
};

/// What adapts a type to the Environment concept. The primary template forwards to members of the same names; to adapt
/// a foreign type, specialise it with all of
///
///     Scalar, axes, parameters       the real, the number of axes, the number N of parameters of an axis
///     linear                         whether the force is affine in (x, v), its tangent the same everywhere
///     decoupled                      whether the force of an axis depends on that axis alone (member optional: true)
///     bilateral                      whether force = regressor' theta + known part holds everywhere (member optional:
///                                    true); else the force is that, or zero where the tool is not in contact
///     regressor(e, x, v)             phi: a row for each axis, a column for each parameter
///     force(e, theta, x, v)          N, positive against the press; theta shaped as phi
///     tangent(e, theta, x, v)        Tangents
///     response(e, theta, x, v)       ForceAndTangent (optional: where both share work; see `response_of`)
///
/// Laws: force(theta) = (phi * theta).rowwise().sum() + force(0); the tangent is the derivative of the force; the
/// response is both, to some roundings; all are finite for finite arguments of a palpation's size, `noexcept`, and
/// allocate nothing.
template <typename E>
struct EnvironmentTraits {};

/// The members to which EnvironmentTraits forwards.
template <typename E>
concept HasEnvironmentMembers = requires(const E& e, const Eigen::Array<typename E::Scalar, E::axes, 1>& x,
                                         const Eigen::Array<typename E::Scalar, E::axes, E::parameters>& theta) {
  typename Tangents<E::axes, typename E::Scalar>;
  { E::linear } -> std::convertible_to<bool>;
  e.regressor(x, x);
  e.force(theta, x, x);
  e.tangent(theta, x, x);
};

template <HasEnvironmentMembers E>
struct EnvironmentTraits<E> {
  using Scalar = typename E::Scalar;
  static constexpr int axes = E::axes;
  static constexpr int parameters = E::parameters;
  static constexpr bool linear = E::linear;
  static constexpr bool decoupled = [] {
    if constexpr (requires { E::decoupled; }) return E::decoupled;
    return true;
  }();
  static constexpr bool bilateral = [] {
    if constexpr (requires { E::bilateral; }) return E::bilateral;
    return true;
  }();

  using Vector = Eigen::Array<Scalar, axes, 1>;
  using Theta = Eigen::Array<Scalar, axes, parameters>;

  static Theta regressor(const E& e, const Vector& x, const Vector& v) noexcept { return e.regressor(x, v); }

  static Vector force(const E& e, const Theta& theta, const Vector& x, const Vector& v) noexcept {
    return e.force(theta, x, v);
  }

  static Tangents<axes, Scalar> tangent(const E& e, const Theta& theta, const Vector& x, const Vector& v) noexcept {
    return e.tangent(theta, x, v);
  }

  static ForceAndTangent<axes, Scalar> response(const E& e, const Theta& theta, const Vector& x,
                                                const Vector& v) noexcept {
    if constexpr (requires { e.response(theta, x, v); }) {
      return e.response(theta, x, v);
    } else {
      return {e.force(theta, x, v), e.tangent(theta, x, v)};
    }
  }
};

/// Positions, velocities and forces: one entry for each axis.
template <typename E>
using EnvironmentVector = Eigen::Array<typename EnvironmentTraits<E>::Scalar, EnvironmentTraits<E>::axes, 1>;

/// Parameters and regressors: a row for each axis, a column for each parameter.
template <typename E>
using EnvironmentTheta =
    Eigen::Array<typename EnvironmentTraits<E>::Scalar, EnvironmentTraits<E>::axes, EnvironmentTraits<E>::parameters>;

/// A model of what the tool touches: a force linear in N parameters an axis, eq. (3.32). See EnvironmentTraits.
template <typename E>
concept Environment = std::copyable<E> && Real<typename EnvironmentTraits<E>::Scalar> &&
                      (EnvironmentTraits<E>::axes > 0) &&
                      (EnvironmentTraits<E>::parameters > 0) &&
                      requires(const E& e, const EnvironmentTheta<E>& theta, const EnvironmentVector<E>& x) {
  { EnvironmentTraits<E>::linear } -> std::convertible_to<bool>;
  { EnvironmentTraits<E>::decoupled } -> std::convertible_to<bool>;
  { EnvironmentTraits<E>::bilateral } -> std::convertible_to<bool>;
  { EnvironmentTraits<E>::regressor(e, x, x) } -> std::convertible_to<EnvironmentTheta<E>>;
  { EnvironmentTraits<E>::force(e, theta, x, x) } -> std::convertible_to<EnvironmentVector<E>>;
  {
    EnvironmentTraits<E>::tangent(e, theta, x, x)
    } -> std::convertible_to<Tangents<EnvironmentTraits<E>::axes, typename EnvironmentTraits<E>::Scalar>>;
};

/// Force and tangent at a point, in one evaluation where the environment's traits know of one.
/// @realtime  as E, no allocation, no throw
template <Environment E>
[[nodiscard]] ForceAndTangent<EnvironmentTraits<E>::axes, typename EnvironmentTraits<E>::Scalar> response_of(
    const E& e, const EnvironmentTheta<E>& theta, const EnvironmentVector<E>& x,
    const EnvironmentVector<E>& v) noexcept {
  using Traits = EnvironmentTraits<E>;
  if constexpr (requires { Traits::response(e, theta, x, v); }) {
    return Traits::response(e, theta, x, v);
  } else {
    return {Traits::force(e, theta, x, v), Traits::tangent(e, theta, x, v)};
  }
}

/// An environment whose force is affine in position and velocity: exact steps exist for all time.
template <typename E>
concept LinearEnvironment = Environment<E> && EnvironmentTraits<E>::linear;

/// An environment whose axes do not feel each other.
template <typename E>
concept DecoupledEnvironment = Environment<E> && EnvironmentTraits<E>::decoupled;

}  // namespace limpid
