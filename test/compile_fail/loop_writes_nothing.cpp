// SPDX-License-Identifier: MIT
// expect: loop_is_sound<limpid::loop_error::block<[^<]*Printer>::writes_nothing
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"

using namespace scene;
using limpid::inputs, limpid::make_block, limpid::make_loop, limpid::Previous, limpid::signals, limpid::wants;

int main() {
  auto loop = make_loop<wants<Sample>, inputs<Force>>(
      Sampling{}, make_block<struct Printer, signals<Sample>, signals<>>([](Time, double) {}));
  return loop.step(Time{0}, 1.0).get<Sample>() > 0;
}
