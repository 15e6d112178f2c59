// SPDX-License-Identifier: MIT
// expect: has<B>.*scene::Estimation|B = scene::Estimation
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"

using namespace scene;
using limpid::inputs, limpid::make_block, limpid::make_loop, limpid::Previous, limpid::signals, limpid::wants;

int main() {
  auto loop = make_loop<wants<Sample>, inputs<Force>>(Sampling{}, Estimation{});
  return loop.block<Estimation>().covariance[0] > 0;
}
