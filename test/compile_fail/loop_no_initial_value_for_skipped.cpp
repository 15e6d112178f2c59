// SPDX-License-Identifier: MIT
// expect: signal<scene::Sample>::needs_a_static_function_initial_because
// expect: its_writer_may_be_skipped<[^<]*Sampler>
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"

using namespace scene;
using limpid::inputs, limpid::make_block, limpid::make_loop, limpid::Previous, limpid::signals, limpid::wants;

int main() {
  auto loop = make_loop<wants<Sample>, inputs<Force>>(make_block<struct Sampler, signals<Force>, signals<Sample>>(
      [](Time, double force) { return force; }, [](Time, double force) { return force > 0; }));
  return loop.step(Time{0}, 1.0).get<Sample>() > 0;
}
