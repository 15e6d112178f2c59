// SPDX-License-Identifier: MIT
// expect: signal<scene::Force>::needs_a_static_function_initial_because
// expect: it_is_read_as_Previous_by<[^<]*Observer>
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"

using namespace scene;
using limpid::inputs, limpid::make_block, limpid::make_loop, limpid::Previous, limpid::signals, limpid::wants;

int main() {
  auto loop = make_loop<wants<Motion>, inputs<Force>>(
      make_block<struct Observer, signals<Previous<Force>>, signals<Motion>>([](Time, double force) { return force; }));
  return loop.step(Time{0}, 1.0).get<Motion>() > 0;
}
