// SPDX-License-Identifier: MIT
// expect: block<[^<]*Halver>::cannot_be_called_with<std::chrono::duration<.*, double>
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"

using namespace scene;
using limpid::inputs, limpid::make_block, limpid::make_loop, limpid::Previous, limpid::signals, limpid::wants;

int main() {
  auto loop = make_loop<wants<Sample>, inputs<Force>>(
      make_block<struct Halver, signals<Force>, signals<Sample>>([](double force) { return force / 2; }));  // no time
  return loop.step(Time{0}, 1.0).get<Sample>() > 0;
}
