// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/environment/environment.hpp>

#include <Eigen/Core>

#include <array>

namespace limpid {

/// An environment some of whose parameters are known, which leaves fewer to estimate: `Fixed<Tangent<3>, 1>` knows the
/// damping of (3.33) and keeps (k, c).
///
///     theta_E = (theta, known)     phi = columns of phi_E that are free     force(theta) = phi' theta + force(0)
///
/// force(0) is the known parameters' part.
/// @tparam E      the environment
/// @tparam Known  indices of its known parameters, ascending; at least one parameter stays free
/// @realtime      as E, no allocation, no throw
template <Environment E, int... Known>
class Fixed {
  using Traits = EnvironmentTraits<E>;
  static constexpr int known_parameters = static_cast<int>(sizeof...(Known));

  static constexpr bool ascending(std::array<int, sizeof...(Known)> indices) {
    int last = -1;
    for (const int index : indices) {
      if (index <= last || index >= Traits::parameters) return false;
      last = index;
    }
    return true;
  }
  static_assert(known_parameters > 0 && known_parameters < Traits::parameters,
                "Fixed: at least one parameter is known and at least one is free");
  static_assert(ascending({Known...}), "Fixed: Known are indices of parameters, ascending");

 public:
  using Scalar = typename Traits::Scalar;
  static constexpr int axes = Traits::axes;
  static constexpr int parameters = Traits::parameters - known_parameters;
  static constexpr bool linear = Traits::linear;
  static constexpr bool decoupled = Traits::decoupled;
  static constexpr bool bilateral = Traits::bilateral;

  using Vector = EnvironmentVector<E>;
  using Theta = Eigen::Array<Scalar, axes, parameters>;
  using Values = Eigen::Array<Scalar, axes, known_parameters>;

  struct Settings {
    E environment{};
    Values known = Values::Zero();  ///< values of the known parameters, a column each, in their units
  };

  /// @throws std::invalid_argument  where a known value is not finite
  explicit Fixed(const Settings& settings) : environment_{settings.environment} {
    expect(is_finite(settings.known), "Fixed: known", "finite", settings.known);
    int column = 0;
    ((full_.col(Known) = settings.known.col(column++)), ...);
  }

  [[nodiscard]] Theta regressor(const Vector& x, const Vector& v) const noexcept {
    const EnvironmentTheta<E> phi = Traits::regressor(environment_, x, v);
    Theta free;
    for (int i = 0; i < parameters; ++i) free.col(i) = phi.col(free_indices[static_cast<std::size_t>(i)]);
    return free;
  }

  [[nodiscard]] Vector force(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return Traits::force(environment_, full(theta), x, v);
  }

  [[nodiscard]] Tangents<axes, Scalar> tangent(const Theta& theta, const Vector& x, const Vector& v) const noexcept {
    return Traits::tangent(environment_, full(theta), x, v);
  }

  [[nodiscard]] ForceAndTangent<axes, Scalar> response(const Theta& theta, const Vector& x,
                                                       const Vector& v) const noexcept {
    return response_of(environment_, full(theta), x, v);
  }

 private:
  static constexpr std::array<int, static_cast<std::size_t>(parameters)> free_indices = [] {
    std::array<int, static_cast<std::size_t>(parameters)> indices{};
    std::size_t next = 0;
    for (int i = 0; i < Traits::parameters; ++i) {
      if (((i != Known) && ...)) indices[next++] = i;
    }
    return indices;
  }();

  [[nodiscard]] EnvironmentTheta<E> full(const Theta& theta) const noexcept {
    EnvironmentTheta<E> all = full_;
    for (int i = 0; i < parameters; ++i) all.col(free_indices[static_cast<std::size_t>(i)]) = theta.col(i);
    return all;
  }

  E environment_;
  EnvironmentTheta<E> full_ = EnvironmentTheta<E>::Zero();  // theta_E with zeros for the free ones
};

}  // namespace limpid
