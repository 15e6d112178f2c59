// SPDX-License-Identifier: MIT
// expect: block<[^<]*Sampler>::has_an_active_that_cannot_be_called_with<std::chrono::duration<.*, double>
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"

using namespace scene;
using limpid::inputs, limpid::make_block, limpid::make_loop, limpid::Previous, limpid::signals, limpid::wants;

struct Sampler : Sampling {
  bool active(Time) const { return true; }  // not the force
};

int main() {
  auto loop = make_loop<wants<Sample>, inputs<Force>>(Sampler{});
  return loop.step(Time{0}, 1.0).get<Sample>() > 0;
}
