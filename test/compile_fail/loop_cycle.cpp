// SPDX-License-Identifier: MIT
// expect: a_cycle<
// expect: block<scene::Tracking>::reads<scene::Motion>::from<[^<]*Arm>
// expect: block<[^<]*Arm>::reads<scene::Torque>::from<scene::Tracking>
// expect: without_Previous
#include <limpid/loop/loop.hpp>

#include "loop/scene.hpp"

using namespace scene;
using limpid::inputs, limpid::make_block, limpid::make_loop, limpid::Previous, limpid::signals, limpid::wants;

int main() {
  auto loop = make_loop<wants<Torque>, inputs<Force>>(
      Tracking{}, make_block<struct Arm, signals<Torque>, signals<Motion>>([](Time, double torque) { return torque; }));
  return loop.step(Time{0}, 1.0).get<Torque>() > 0;
}
