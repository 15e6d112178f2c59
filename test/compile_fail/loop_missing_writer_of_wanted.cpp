// SPDX-License-Identifier: MIT
// expect: loop_is_sound<limpid::loop_error::no_block_writes<scene::Torque>::which_is_wanted
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"

using namespace scene;
using limpid::inputs, limpid::make_block, limpid::make_loop, limpid::Previous, limpid::signals, limpid::wants;

int main() {
  auto loop = make_loop<wants<Torque>, inputs<Force>>(Sampling{}, KnownPrediction{});
  return loop.step(Time{0}, 1.0).get<Torque>() > 0;
}
