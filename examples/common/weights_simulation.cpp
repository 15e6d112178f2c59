// SPDX-License-Identifier: MIT
#include "weights_simulation.hpp"

#include <limpid/device/simulated_force_sensor.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace limpid::examples {

SimulatedWeights simulate_weights(const WeightsOptions& options) {
  SimulatedWeights simulated;
  simulated.counts_per_newton << 1087.4, 75, 9,  //
      -60, -1089.1, 7,                           //
      102, -9, 120.5;
  simulated.offset << 120, -340, 55;
  // The simulated sensor gives newtons, by each axis's own sensitivity; its counts are whole.
  const Eigen::Vector3d sensitivity = simulated.counts_per_newton.diagonal();
  SimulatedForceSensor<> sensor({.response = sensitivity.cwiseInverse().asDiagonal() * simulated.counts_per_newton,
                                 .noise = Eigen::Vector3d::Constant(options.noise),
                                 .seed = options.seed});
  const double lever = 1 + options.lever_gain * options.lever_arm;
  Time now{};
  constexpr auto hanging = std::chrono::seconds(1);       // until the weight hangs still
  constexpr auto between = std::chrono::milliseconds(3);  // there is a new frame in each
  for (int twice = 0; twice < 2; ++twice) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int newtons = -5; newtons <= (axis == 2 ? 8 : 5); ++newtons) {
        const Eigen::Vector3d force = newtons * Eigen::Vector3d::Unit(axis);
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        (void)sensor.advance(now += hanging, force * lever);
        for (int frame = 0; frame < options.frames; ++frame) {
          (void)sensor.advance(now += between, force * lever);
          const Eigen::Vector3d counts = sensor.read(now).force.cwiseProduct(sensitivity) + simulated.offset;
          for (int i = 0; i < 3; ++i) sum[i] += std::clamp(std::round(counts[i]), -32768.0, 32767.0);
        }
        simulated.loads.push_back({force, sum / options.frames});
      }
    }
  }
  return simulated;
}

}  // namespace limpid::examples
