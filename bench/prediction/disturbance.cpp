// SPDX-License-Identifier: MIT
#include "prediction/disturbance.hpp"

namespace limpid::bench {

const std::vector<Disturbance>& disturbances() {
  // Some of the predictors have Maxwell branches with lags of .1, .3 and 1 s.
  static const std::vector<Disturbance> all{
      {.name = "clean", .late_asked = 0.002},
      {.name = "force-noise-10mN", .sensing = {.force_noise = 0.01}},
      {.name = "force-noise-30mN", .sensing = {.force_noise = 0.03}},
      {.name = "state-noise", .sensing = {.position_noise = 3e-6, .velocity_noise = 1e-4}, .late_asked = 0.06},
      {.name = "quantised", .sensing = {.position_step = 1e-5, .force_step = 0.01}},
      {.name = "stiffness-step", .tissue = {.step = 1.3}},
      {.name = "idle-step", .tissue = {.step = 1.3}, .idle = true},
      {.name = "softening", .tissue = {.softening = 0.02}},
      {.name = "jitter", .sensing = {.jitter = 0.2}},
      {.name = "loss", .sensing = {.loss = 0.05}},
      {.name = "relaxation", .tissue = {.relaxation = 200, .lag = 0.3}},
      {.name = "relaxation-off-grid", .tissue = {.relaxation = 200, .lag = 0.55}},
      {.name = "depth-damping", .tissue = {.damping_growth = 1e4}},
      {.name = "coulomb", .tissue = {.friction = 0.1}, .late_asked = 0.15},
      {.name = "all",
       .tissue = {.softening = 0.005, .relaxation = 60, .lag = 0.4, .damping_growth = 3e3, .friction = 0.02},
       .sensing = {.force_noise = 0.005, .position_noise = 1e-6, .velocity_noise = 3e-5, .jitter = 0.1, .loss = 0.02},
       .late_asked = 0.06},
  };
  return all;
}

}  // namespace limpid::bench
