// SPDX-License-Identifier: MIT
#include "scenes/scene.hpp"

#include <cstdio>

namespace limpid::bench {

bool premises_hold(std::vector<Scene>& scenes) {
  bool hold = true;
  for (Scene& scene : scenes) {
    const std::string broken = scene.broken_premise();
    if (broken.empty()) continue;
    hold = false;
    std::fprintf(stderr, "%s is not what it is to be: %s\n", scene.name().c_str(), broken.c_str());
  }
  return hold;
}

}  // namespace limpid::bench
