// SPDX-License-Identifier: MIT
// expect: loop_is_sound<limpid::loop_error::the_input<scene::Sample>::is_also_written_by<scene::Sampling>
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"

using namespace scene;
using limpid::inputs, limpid::make_block, limpid::make_loop, limpid::Previous, limpid::signals, limpid::wants;

int main() {
  auto loop = make_loop<wants<Estimate>, inputs<Force, Sample>>(Sampling{}, Estimation{});
  return loop.step(Time{0}, 1.0, 1.0).get<Estimate>() > 0;
}
