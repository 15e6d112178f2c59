// SPDX-License-Identifier: MIT
// What each scene's whole tick costs: bytes of the loop, instructions, and time; 1 where a scene is not what it is to
// be.
#include "scenes/scene.hpp"

#include "count_instructions.hpp"
#include "thread_time.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace {

using namespace limpid::bench;

// A mean over the longest period of a sample.
constexpr long ticks = 16;

/// Of processor time.
double median_of_turns(Scene& scene) {
  constexpr int turns = 500, ticks_a_turn = 320;
  std::vector<double> ns;
  for (int turn = 0; turn < turns; ++turn) {
    const double start = thread_ns();
    scene.run(ticks_a_turn);
    ns.push_back((thread_ns() - start) / ticks_a_turn);
  }
  std::nth_element(ns.begin(), ns.begin() + turns / 2, ns.end());
  return ns[turns / 2];
}

}  // namespace

int main(int argc, char**) {
  if (argc > 1) {
    std::fputs("scenes: takes no arguments\n", stderr);
    return 2;
  }
  std::vector<Scene> scenes = all_scenes();
  if (!premises_hold(scenes)) return 1;
  std::printf("%-48s %8s %14s %8s\n", "the whole tick, a sample every 16 ms", "bytes", "instructions", "ns");
  for (Scene& scene : scenes) {
    const double ns = median_of_turns(scene);
    const long once = count_instructions([&] { scene.run(ticks); });
    const long twice = count_instructions([&] { scene.run(2 * ticks); });
    if (once < 0 || twice < 0) {
      std::fprintf(stderr, "scenes: this system does not let a process be traced\n");
      return 1;
    }
    std::printf("%-48s %8zu %14ld %8.0f\n", scene.name().c_str(), scene.bytes(), (twice - once) / ticks, ns);
  }
  return 0;
}
