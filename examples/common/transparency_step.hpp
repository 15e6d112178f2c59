// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/sampled_wall.hpp>

#include <array>
#include <vector>

namespace limpid::examples {

/// Response of the sampled loop to a force that the operator holds from t = 0 on, Figs. 7 and 10 of the paper.
struct StepResponse {
  static constexpr std::array<double, 5> times{0.001, 0.005, 0.010, 0.020, 0.050};  ///< of `points`, s

  double gain = 0;                 ///< B_c
  double end = 0;                  ///< F_h/K_c, where it settles, m
  double overshoot = 0;            ///< of the samples, part of `end`; NaN where it does not settle
  double settling = 0;             ///< from when on all samples are within 2 % of `end`, s; NaN where it does not
  std::array<double, 5> points{};  ///< x at `times`, also between samples, m; NaN where it has grown out of range
  std::vector<double> time{}, position{}, force{};  ///< of the samples, s, m, N: F_d on the device; some 5000 at most
};

/// From rest at x = 0.
[[nodiscard]] StepResponse step_response(const SampledWall<>& loop, const HapticPlant<>& plant,
                                         const WallFeedback<>& feedback, double force);

}  // namespace limpid::examples
