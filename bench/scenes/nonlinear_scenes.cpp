// SPDX-License-Identifier: MIT
#include "scenes/scene.hpp"

#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/unilateral.hpp>

namespace limpid::bench {
namespace {

template <typename Env>
Scene known(std::string name, const Env& environment, const EnvironmentTheta<Env>& theta,
            const GainRow<Env::axes>& gain, const Course& course) {
  using namespace std::chrono_literals;
  constexpr int axes = Env::axes;
  using Model = ModelPredictor<Env, Tool<axes>, Known>;
  using Block = palpation::PredictionBlock<Model, axes>;
  const Tool<axes> tool{.mass = 0.1, .damping = 0.1};
  const Model model({.environment = environment, .tool = tool, .theta = theta, .gain = {gain.L1, gain.L2}});
  return Scene::of<Block>(std::move(name), {}, scene_loop<axes>(16ms, Block{model}),
                          inputs_along(course, environment, theta, tool));
}

}  // namespace

// The thesis's gain is for contact. For samples every 16 ms, 16 ms late, the error grows by 1.18 a sample where the
// wall is not touched, and shrinks to 0.51 in it; with the smaller gain it shrinks to 0.88 and 0.54 (`sampled_radius`).
void add_nonlinear_scenes(std::vector<Scene>& scenes) {
  using Wall = Unilateral<KelvinVoigt<1>>;
  const GainRow<1> of_contact(-195.1, -4.89), of_both(-20, -1.5);
  const HuntCrossley<1> one({.exponent = 1.3});
  const HuntCrossley<3> three({.exponent = 1.3});
  const Wall wall{Wall::Settings{}};
  const Course inside{.middle = {5e-4, 0, 0}, .amplitude = press.amplitude},
      outside{.middle = {-1e-2, 0, 0}, .amplitude = press.amplitude};
  scenes.push_back(known("1 axis, Hunt-Crossley, known", one, {1e4, 1e3, 30}, of_contact, press));
  scenes.push_back(known("3 axes, Hunt-Crossley, known", three,
                         EnvironmentTheta<HuntCrossley<3>>(Eigen::RowVector3d(1e4, 1e3, 30).array().replicate<3, 1>()),
                         GainRow<3>(-195.1, -4.89), press));
  scenes.push_back(known("1 axis, one-sided wall, contact", wall, {900, 25}, of_both, inside));
  scenes.push_back(known("1 axis, one-sided wall, to and fro", wall, {900, 25}, of_both, press));
  scenes.push_back(known("1 axis, one-sided wall, free space", wall, {900, 25}, of_both, outside));
}

}  // namespace limpid::bench
