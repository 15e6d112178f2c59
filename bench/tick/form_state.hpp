// SPDX-License-Identifier: MIT
#pragma once

#include "tick/library_tick.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <type_traits>

namespace limpid::bench {

/// What a form gave in a tick and knows after it, in double.
struct FormState {
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< N m
  std::array<Eigen::Vector2d, 3> theta{};            ///< of each axis (k, b), N/m and N s/m
  std::array<Eigen::Matrix2d, 3> Gamma{};
};

/// N m, of what a form returns: a torque, one that is safe, either with a status, or the result of a loop.
template <typename Output>
[[nodiscard]] Eigen::Vector3d torque_of(const Output& output) {
  if constexpr (std::is_base_of_v<Eigen::EigenBase<Output>, Output>) {
    return output.template cast<double>();
  } else if constexpr (requires { output.value(); }) {
    return torque_of(output.value());
  } else if constexpr (requires { output.torque; }) {
    return torque_of(output.torque);
  } else {
    return torque_of(output.template get<0>());
  }
}

/// theta and Gamma of a tick by hand, of the library's parts, or of a loop of them.
template <typename Scalar, typename Tick>
void see_law(const Tick& tick, FormState& state) {
  using Block = palpation::AdaptationBlock<KelvinVoigt<3, Scalar>>;
  if constexpr (requires { tick.template block<Block>(); }) {
    see_law<Scalar>(tick.template block<Block>().component.law(), state);
  } else if constexpr (requires { tick.estimator; }) {
    see_law<Scalar>(tick.estimator.law(), state);
  } else {
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      if constexpr (requires { tick.gain(axis); }) {
        state.theta[i] = tick.theta().row(axis).transpose().matrix().template cast<double>();
        state.Gamma[i] = tick.gain(axis).template cast<double>();
      } else if constexpr (requires { tick.Gamma(axis); }) {
        state.theta[i] = tick.theta(axis);
        state.Gamma[i] = tick.Gamma(axis);
      }
    }
  }
}

}  // namespace limpid::bench
