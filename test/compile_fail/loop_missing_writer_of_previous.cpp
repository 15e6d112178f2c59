// SPDX-License-Identifier: MIT
// expect: loop_is_sound<limpid::loop_error::no_block_writes<scene::Torque>::which<[^<]*Observer>::reads
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"

using namespace scene;
using limpid::inputs, limpid::make_block, limpid::make_loop, limpid::Previous, limpid::signals, limpid::wants;

int main() {
  auto loop =
      make_loop<wants<Motion>, inputs<Force>>(make_block<struct Observer, signals<Previous<Torque>>, signals<Motion>>(
          [](Time, double torque) { return torque; }));
  return loop.step(Time{0}, 1.0).get<Motion>() > 0;
}
