// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/sampled_wall.hpp>
#include <limpid/design/transparency_problem.hpp>

#include <limits>
#include <optional>
#include <vector>

namespace limpid::examples {

/// What `transparency` is asked about.
struct TransparencyTask {
  TransparencyProblem<> problem{};
  double weight = 100;                       ///< cut-off of the first-order w1, rad/s
  bool free = false;                         ///< whether K_c is sought too, else K_c = K
  std::vector<double> gains{};               ///< B_c of the table, N s/m
  std::vector<VelocitySource> velocities{};  ///< of the sampled loops that are judged, the main one first
  VelocitySource step_velocity = VelocitySource::backward_difference;
  double delay = 0;                                         ///< of the sampled loop, s
  double cutoff = std::numeric_limits<double>::infinity();  ///< of the velocity's low-pass, Hz
  double radius = 1;                                        ///< that the sampled loop's has to be below
  std::optional<double> force{};                            ///< of the step, N

  [[nodiscard]] SampledWall<> loop(VelocitySource velocity) const {
    return {.period = problem.period, .delay = delay, .velocity = velocity, .cutoff = cutoff};
  }
  [[nodiscard]] PlantBox<> box() const { return PlantBox<>::around(problem.plant, problem.uncertainty); }
};

[[nodiscard]] constexpr const char* name(VelocitySource velocity) {
  return velocity == VelocitySource::sampled ? "sampled" : "difference";
}

}  // namespace limpid::examples
