// SPDX-License-Identifier: MIT
#pragma once

#include "weights_options.hpp"

#include <limpid/device/force_calibration_fit.hpp>

#include <vector>

namespace limpid::examples {

/// A simulated sensor, and the weights that were hung on it.
struct SimulatedWeights {
  Eigen::Matrix3d counts_per_newton;  ///< at the flange
  Eigen::Vector3d offset;             ///< counts
  std::vector<CalibrationLoad<>> loads;
};

/// The weights of section 5.3.3, -5 to 5 N along x and y and -5 to 8 N along z, each twice, on a sensor with the
/// sensitivities of Table 5.5 and cross-talk as that section tells: 5 to 10 %, of x on z 85 %.
[[nodiscard]] SimulatedWeights simulate_weights(const WeightsOptions& options);

}  // namespace limpid::examples
