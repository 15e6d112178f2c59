// SPDX-License-Identifier: MIT
// expect: two_blocks_write<scene::Motion>::namely<scene::KnownPrediction, scene::EstimatedPrediction>
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"

using namespace scene;
using limpid::inputs, limpid::make_block, limpid::make_loop, limpid::Previous, limpid::signals, limpid::wants;

int main() {
  auto loop = make_loop<wants<Torque>, inputs<Force>>(Sampling{}, KnownPrediction{}, Estimation{},
                                                      EstimatedPrediction{}, Tracking{});
  return loop.step(Time{0}, 1.0).get<Torque>() > 0;
}
