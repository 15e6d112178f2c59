// SPDX-License-Identifier: MIT
#include "scenes/scene.hpp"

namespace limpid::bench {
namespace {

using namespace std::chrono_literals;

template <int Axes>
EnvironmentTheta<KelvinVoigt<Axes>> of(double k, double b) {
  EnvironmentTheta<KelvinVoigt<Axes>> theta;
  theta.col(0).setConstant(k);
  theta.col(1).setConstant(b);
  return theta;
}

/// k from 200 to 2000 N/m and b from 20 to 40 N s/m are sought.
template <int Axes>
Scene estimated(std::string name, Duration period, const Course& course = press,
                const EnvironmentTheta<KelvinVoigt<Axes>>& truth = tick_tissue().topRows<Axes>(),
                const Premise& premise = {}) {
  using Env = KelvinVoigt<Axes>;
  using Model = ModelPredictor<Env>;
  using Block = palpation::AdaptivePredictionBlock<Model, Env>;
  const Tool<Axes> tool{.mass = 0.1, .damping = 0.1};
  const Model model({.environment = {}, .tool = tool, .theta = of<Axes>(1100, 30), .gain = {-195.1, -4.89}});
  const EnvironmentEstimator<Env> estimator({.environment = {},
                                             .law = {.lower = of<Axes>(200, 20),
                                                     .upper = of<Axes>(2000, 40),
                                                     .initial = of<Axes>(1100, 30),
                                                     .initial_gain = of<Axes>(1e9, 8e6)}});
  return Scene::of<Block>(std::move(name), premise,
                          scene_loop<Axes>(period, palpation::AdaptationBlock<Env>{estimator}, Block{model}),
                          inputs_along(course, Env{}, truth, tool));
}

}  // namespace

// Where an axis is at rest the estimator's gain grows to its limit, which the slower path of a tick keeps; so does a
// truth outside the box, to which each tick brings the estimate back.
void add_estimated_scenes(std::vector<Scene>& scenes) {
  const Course still{.middle = press.amplitude}, nothing{}, along_x{.amplitude = {press.amplitude[0], 0, 0}};
  scenes.push_back(estimated<1>("1 axis, linear, estimated", 16ms));
  scenes.push_back(estimated<3>("3 axes, linear, estimated", 16ms));
  scenes.push_back(estimated<3>("3 axes, linear, estimated, each tick a sample", 1ms));
  scenes.push_back(estimated<3>("  the same, holding still", 1ms, still));
  scenes.push_back(estimated<3>("  the same, nothing touched", 1ms, nothing));
  scenes.push_back(estimated<3>("  the same, two axes at rest", 1ms, along_x));
  scenes.push_back(estimated<3>("  the same, softer than the box", 1ms, press, of<3>(100, 10),
                                {.may = Status::at_bound, .must = Status::at_bound}));
}

}  // namespace limpid::bench
