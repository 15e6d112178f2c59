// SPDX-License-Identifier: MIT
#include "scenes/scene.hpp"

namespace limpid::bench {
namespace {

template <int Axes>
Scene known(std::string name, double tool_stiffness) {
  using namespace std::chrono_literals;
  using Model = ModelPredictor<KelvinVoigt<Axes>, Tool<Axes>, Known>;
  EnvironmentTheta<KelvinVoigt<Axes>> theta;
  theta.col(0).setConstant(900);
  theta.col(1).setConstant(25);
  const Model model({.environment = {},
                     .tool = {.mass = 0.1, .damping = 0.1, .stiffness = tool_stiffness},
                     .theta = theta,
                     .gain = {-195.1, -4.89}});
  return Scene::of<Axes>(std::move(name), scene_loop<Axes>(16ms, palpation::PredictionBlock<Model, Axes>{model}), true);
}

}  // namespace

void add_known_scenes(std::vector<Scene>& scenes) {
  scenes.push_back(known<1>("1 axis, linear, known", 0));
  scenes.push_back(known<3>("3 axes, linear, known", 0));
  scenes.push_back(known<3>("3 axes, linear, known, tool spring", 200));
}

}  // namespace limpid::bench
