// SPDX-License-Identifier: MIT
// expect: loop_is_sound<limpid::loop_error::block<[^<]*Halver>::returns<float>::instead_of<double>
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"

using namespace scene;
using limpid::inputs, limpid::make_block, limpid::make_loop, limpid::Previous, limpid::signals, limpid::wants;

int main() {
  auto loop = make_loop<wants<Sample>, inputs<Force>>(
      make_block<struct Halver, signals<Force>, signals<Sample>>([](Time, double) { return 0.5F; }));
  return loop.step(Time{0}, 1.0).get<Sample>() > 0;
}
