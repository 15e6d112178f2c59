// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/environment/fixed.hpp>
#include <limpid/environment/tangent_model.hpp>
#include <limpid/estimation/environment_estimator.hpp>

namespace limpid::examples {

/// The thesis's model of a nonlinear tissue (6.2.2), F_e = k x + c + b v with k and c estimated and b known.
using OffsetModel = Fixed<Tangent<1>, 1>;

/// @param stiffness  where k starts, N/m
/// @param damping    b, N s/m
[[nodiscard]] inline EnvironmentEstimator<OffsetModel>::Settings offset_estimation(double stiffness, double damping) {
  EnvironmentEstimator<OffsetModel>::Settings settings{
      .environment = OffsetModel({.known = OffsetModel::Values(damping)}), .law = {}};
  settings.law.lower << 200, -55;
  settings.law.upper << 2000, 0;
  settings.law.initial << stiffness, 0;
  settings.law.initial_gain << 1e9, 1e4;
  settings.law.forgetting = 20;
  return settings;
}

}  // namespace limpid::examples
