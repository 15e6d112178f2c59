// SPDX-License-Identifier: MIT
#include "scenes/scene.hpp"

#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/unilateral.hpp>

namespace limpid::bench {
namespace {

template <typename Env>
Scene known(std::string name, const Env& environment, const EnvironmentTheta<Env>& theta, bool touching) {
  using namespace std::chrono_literals;
  constexpr int axes = Env::axes;
  using Model = ModelPredictor<Env, Tool<axes>, Known>;
  const Model model(
      {.environment = environment, .tool = {.mass = 0.1, .damping = 0.1}, .theta = theta, .gain = {-195.1, -4.89}});
  return Scene::of<axes>(std::move(name), scene_loop<axes>(16ms, palpation::PredictionBlock<Model, axes>{model}),
                         touching);
}

}  // namespace

void add_nonlinear_scenes(std::vector<Scene>& scenes) {
  using Wall = Unilateral<KelvinVoigt<1>>;
  const HuntCrossley<1> one({.exponent = 1.3});
  const HuntCrossley<3> three({.exponent = 1.3});
  scenes.push_back(known("1 axis, Hunt-Crossley, known", one, {1500, 1, 30}, true));
  scenes.push_back(known("3 axes, Hunt-Crossley, known", three,
                         EnvironmentTheta<HuntCrossley<3>>(Eigen::RowVector3d(1500, 1, 30).array().replicate<3, 1>()),
                         true));
  scenes.push_back(known("1 axis, one-sided wall, contact", Wall(Wall::Settings{}), {900, 25}, true));
  scenes.push_back(known("1 axis, one-sided wall, free space", Wall(Wall::Settings{}), {900, 25}, false));
}

}  // namespace limpid::bench
