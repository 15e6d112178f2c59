// SPDX-License-Identifier: MIT
// expect: a_cycle<[^<]*block<[^<]*Integrator>::reads<scene::Motion>::from<[^<]*Integrator> *>::without_Previous
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"

using namespace scene;
using limpid::inputs, limpid::make_block, limpid::make_loop, limpid::Previous, limpid::signals, limpid::wants;

int main() {
  auto loop =
      make_loop<wants<Motion>, inputs<Force>>(make_block<struct Integrator, signals<Motion, Force>, signals<Motion>>(
          [](Time, double motion, double force) { return motion + force; }));
  return loop.step(Time{0}, 1.0).get<Motion>() > 0;
}
