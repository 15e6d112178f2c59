// SPDX-License-Identifier: MIT
#include "scenes/scene.hpp"

#include <limpid/prediction/hold_predictor.hpp>

namespace limpid::bench {
namespace {

template <int Axes>
Scene held(std::string name) {
  using namespace std::chrono_literals;
  using Block = palpation::PredictionBlock<HoldPredictor<Axes>, Axes>;
  const auto inputs =
      inputs_along(press, KelvinVoigt<Axes>{}, EnvironmentTheta<KelvinVoigt<Axes>>(tick_tissue().topRows<Axes>()),
                   {.mass = 0.1, .damping = 0.1});
  return Scene::of<Block>(std::move(name), {}, scene_loop<Axes>(16ms, Block{HoldPredictor<Axes>{}}), inputs);
}

}  // namespace

void add_held_scenes(std::vector<Scene>& scenes) {
  scenes.push_back(held<1>("1 axis, held"));
  scenes.push_back(held<3>("3 axes, held"));
}

}  // namespace limpid::bench
