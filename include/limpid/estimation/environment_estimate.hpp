// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/core/time.hpp>

#include <Eigen/Core>

namespace limpid {

/// What an estimator tells a predictor.
/// @tparam N  parameters of an axis
template <int Axes, int N, Real Scalar = double>
struct EnvironmentEstimate {
  using Theta = Eigen::Array<Scalar, Axes, N>;

  Theta theta_hat = Theta::Zero();  ///< row: axis, column: parameter, in the environment's units
  Time stamp{};                     ///< instant that the estimate belongs to
};

}  // namespace limpid
