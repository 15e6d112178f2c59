// SPDX-License-Identifier: MIT
#include "loop_panel.hpp"

#include <array>
#include <cstdio>

namespace limpid::examples {

namespace {

template <typename... Values>
std::string print(const char* format, Values... values) {
  std::array<char, 128> text{};
  (void)std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace

std::vector<std::string> lines_of(const LoopValues& values) {
  const Eigen::Vector3d x = 1e3 * values.position, F = values.force;
  return {print("time      %9.1f s", in_seconds(values.time)),
          print("position  %9.2f %9.2f %9.2f mm", x[0], x[1], x[2]),
          print("force     %9.3f %9.3f %9.3f N, %.3f N", F[0], F[1], F[2], F.norm()),
          print("error     %9.4f mm", 1e3 * values.error),
          print("ticks     %9llu, %llu missed", static_cast<unsigned long long>(values.ticks),
                static_cast<unsigned long long>(values.missed)),
          "status    " + describe(values.status)};
}

}  // namespace limpid::examples
