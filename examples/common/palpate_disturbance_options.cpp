// SPDX-License-Identifier: MIT
#include "palpate_disturbance_options.hpp"

#include "option_checks.hpp"
#include "option_values.hpp"

namespace limpid::examples {

namespace {

void add_sensing_options(CLI::App& app, TypedDisturbances& typed) {
  const auto size = within(0, 1e6);
  const auto add_pair = [&](const char* name, std::vector<double>& pair, const char* what) {
    app.add_option(name, pair, what)->delimiter(',')->expected(2)->check(size);
  };
  app.add_option("--force-noise", typed.force_noise, "SIGMA of the sampled force, N")->check(size);
  add_pair("--state-noise", typed.state_noise, "SX,SV of the sampled depth and velocity, m, m/s");
  add_pair("--quantise", typed.quantise, "DX,DF: steps of the sampled depth and force, m, N; 0: none");
  app.add_option("--jitter", typed.jitter, "FRACTION of the period by which a sample is early or late, at most")
      ->check(within(0, 0.5));
  app.add_option("--loss", typed.loss, "FRACTION of the samples that are lost")->check(within(0, 0.99));
  app.add_option("--seed", typed.seed, "of what is drawn by chance: noise, jitter, loss")->check(whole(4294967295.0));
}

void add_change_options(CLI::App& app, TypedDisturbances& typed) {
  const auto size = within(0, 1e6);
  app.add_option("--stiffness-step", typed.stiffness_step, "AT,FACTOR: s, and what the stiffness is multiplied by then")
      ->delimiter(',')
      ->expected(2)
      ->check(size);
  app.add_option("--soften", typed.soften, "RATE at which the stiffness falls, of itself per s")->check(size);
  app.add_option("--relaxation", typed.relaxation, "K,TAU of a Maxwell branch, N/m, s")
      ->delimiter(',')
      ->expected(2)
      ->check(size);
  app.add_option("--depth-damping", typed.depth_damping, "RATE at which the damping grows with depth, N s/m per m")
      ->check(size);
  app.add_option("--coulomb", typed.coulomb, "F of dry friction in the tissue, N")->check(size);
}

}  // namespace

void add_disturbance_options(CLI::App& app, TypedDisturbances& typed) {
  add_sensing_options(app, typed);
  add_change_options(app, typed);
}

Disturbances disturbances_of(const TypedDisturbances& typed, double duration) {
  if (typed.soften * duration >= 1) {
    refuse("--soften", "a rate below " + text(1 / duration) + " per s, at which the stiffness would be gone at the end",
           text(typed.soften));
  }
  if (typed.stiffness_step[0] > duration) {
    refuse("--stiffness-step", "an instant within the " + text(duration) + " s of the run",
           text(typed.stiffness_step[0]));
  }
  if (typed.relaxation[0] > 0 && typed.relaxation[1] < 1e-3) {
    refuse("--relaxation", "a TAU of at least 0.001 s", text(typed.relaxation[1]));
  }
  Disturbances all;
  all.step_at = typed.stiffness_step[0];
  all.seed = typed.seed;
  all.tissue = {.step = typed.stiffness_step[1],
                .softening = typed.soften,
                .relaxation = typed.relaxation[0],
                .lag = typed.relaxation[1],
                .damping_growth = typed.depth_damping,
                .friction = typed.coulomb};
  all.sensing = {.force_noise = typed.force_noise,
                 .position_noise = typed.state_noise[0],
                 .velocity_noise = typed.state_noise[1],
                 .position_step = typed.quantise[0],
                 .force_step = typed.quantise[1],
                 .jitter = typed.jitter,
                 .loss = typed.loss};
  return all;
}

}  // namespace limpid::examples
