// SPDX-License-Identifier: MIT
// What the loops with a model have in common; included by their sources.
#pragma once

#include "palpation_run.hpp"

#include <limpid/environment/fixed.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/tangent_model.hpp>
#include <limpid/environment/unilateral.hpp>
#include <limpid/prediction/gains.hpp>
#include <limpid/prediction/model_predictor.hpp>

namespace limpid::examples {

/// Ticks that a predictor remembers: samples up to 4 s old at 1 kHz find their own prediction.
inline constexpr std::size_t prediction_history = 4096;

/// The scene's gain on the press axis; a constant one is a scheduled one whose L1 and L2 are zero.
template <int Axes>
[[nodiscard]] ScheduledGain<Axes> gain_of(const Scene& scene) {
  using Vector = Eigen::Array<double, Axes, 1>;
  const auto on_press_axis = [](double value) {
    Vector vector = Vector::Zero();
    vector[0] = value;
    return vector;
  };
  const auto row = [&](std::size_t at) {
    if (at + 1 >= scene.gain.size()) return GainRow<Axes>{};
    return GainRow<Axes>{on_press_axis(scene.gain[at]), on_press_axis(scene.gain[at + 1])};
  };
  const bool scheduled = scene.gain.size() > 2;  // within the box of the design, 6.2.1; a constant gain needs none
  return ScheduledGain<Axes>({.L0 = row(0),
                              .L1 = row(2),
                              .L2 = row(4),
                              .lower = {on_press_axis(scheduled ? 200 : -1e12), on_press_axis(scheduled ? 20 : -1e12)},
                              .upper = {on_press_axis(scheduled ? 2000 : 1e12), on_press_axis(scheduled ? 40 : 1e12)}});
}

}  // namespace limpid::examples
