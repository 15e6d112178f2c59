// SPDX-License-Identifier: MIT
#include "scenes/scene.hpp"

namespace limpid::bench {
namespace {

template <int Axes>
Scene known(std::string name, double tool_stiffness, const Course& course, const Premise& premise) {
  using namespace std::chrono_literals;
  using Env = KelvinVoigt<Axes>;
  using Model = ModelPredictor<Env, Tool<Axes>, Known>;
  using Block = palpation::PredictionBlock<Model, Axes>;
  const Tool<Axes> tool{.mass = 0.1, .damping = 0.1, .stiffness = tool_stiffness};
  const EnvironmentTheta<Env> theta = tick_tissue().topRows<Axes>();
  const Model model({.environment = {}, .tool = tool, .theta = theta, .gain = {-195.1, -4.89}});
  return Scene::of<Block>(std::move(name), premise, scene_loop<Axes>(16ms, Block{model}),
                          inputs_along(course, Env{}, theta, tool));
}

}  // namespace

void add_known_scenes(std::vector<Scene>& scenes) {
  const Course light{.amplitude = {2e-4, 2e-4, 2e-4}};  // its force and the spring's are those of `press`
  const Course hard{.amplitude = {3e-3, 3e-3, 3e-3}};   // ten times the force: more than the device can give
  scenes.push_back(known<1>("1 axis, linear, known", 0, press, {}));
  scenes.push_back(known<3>("3 axes, linear, known", 0, press, {}));
  scenes.push_back(known<3>("3 axes, linear, known, tool spring", 200, light, {}));
  scenes.push_back(
      known<3>("3 axes, linear, known, torque limited", 0, hard, {.may = Status::limited, .must = Status::limited}));
}

}  // namespace limpid::bench
