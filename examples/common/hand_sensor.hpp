// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/simulated_force_sensor.hpp>

#include <cstdint>
#include <optional>

namespace limpid::examples {

/// What tissue, predictor and controller hear of the operator's force: the force itself, or a simulated sensor's.
class HandSensor {
 public:
  explicit HandSensor(const Scene& scene) {
    if (scene.force_sensor) sensor_.emplace(settings_of(*scene.force_sensor, scene.disturbances.seed));
  }

  struct Heard {
    Eigen::Vector3d force;  ///< N, base frame
    Status status;
  };
  /// @param hand  the true force, N, base frame
  [[nodiscard]] Heard hear(Time now, const Eigen::Vector3d& hand) noexcept {
    if (!sensor_) return {hand, Status::ok};
    const Status status = sensor_->advance(now, hand);
    const auto [force, stamp, said] = sensor_->read(now);
    return {force, status | said};
  }

 private:
  static SimulatedForceSensor<>::Settings settings_of(const ForceSensorModel& model, std::uint32_t seed) {
    SimulatedForceSensor<>::Settings settings;
    settings.response.setConstant(model.cross_talk);
    settings.response.diagonal().setOnes();
    settings.noise.setConstant(model.noise);
    settings.seed = seed;
    return settings;
  }

  std::optional<SimulatedForceSensor<>> sensor_;
};

}  // namespace limpid::examples
