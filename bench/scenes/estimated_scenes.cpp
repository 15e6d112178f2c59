// SPDX-License-Identifier: MIT
#include "scenes/scene.hpp"

namespace limpid::bench {
namespace {

template <int Axes>
Scene estimated(std::string name, Duration period) {
  using Env = KelvinVoigt<Axes>;
  using Model = ModelPredictor<Env>;
  const auto of = [](double k, double b) {
    EnvironmentTheta<Env> theta;
    theta.col(0).setConstant(k);
    theta.col(1).setConstant(b);
    return theta;
  };
  const Model model(
      {.environment = {}, .tool = {.mass = 0.1, .damping = 0.1}, .theta = of(1100, 30), .gain = {-195.1, -4.89}});
  const EnvironmentEstimator<Env> estimator(
      {.environment = {},
       .law = {.lower = of(200, 20), .upper = of(2000, 40), .initial = of(1100, 30), .initial_gain = of(1e9, 8e6)}});
  return Scene::of<Axes>(std::move(name),
                         scene_loop<Axes>(period, palpation::AdaptationBlock<Env>{estimator},
                                          palpation::AdaptivePredictionBlock<Model, Env>{model}),
                         true);
}

}  // namespace

void add_estimated_scenes(std::vector<Scene>& scenes) {
  using namespace std::chrono_literals;
  scenes.push_back(estimated<1>("1 axis, linear, estimated", 16ms));
  scenes.push_back(estimated<3>("3 axes, linear, estimated", 16ms));
  scenes.push_back(estimated<3>("3 axes, linear, estimated, each tick a sample", 1ms));
}

}  // namespace limpid::bench
