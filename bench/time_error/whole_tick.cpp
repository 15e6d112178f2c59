// SPDX-License-Identifier: MIT
#include "time_error/whole_tick.hpp"

#include <utility>

namespace limpid::bench {

namespace whole_tick {

namespace {

// The tick in 50 digits is the exact solution here: what its parts truncate is told at their places.
std::vector<Method> methods() {
  const Signals exact = in_50_digits();
  std::vector<Method> methods;
  for (const auto& in_scalar : {in_float, in_double, in_long_double}) {
    for (Method& method : in_scalar(exact)) methods.push_back(std::move(method));
  }
  return methods;
}

}  // namespace

}  // namespace whole_tick

std::vector<Case> whole_tick_cases() { return {{"whole tick", "3 axes, a fresh sample on each", whole_tick::methods}}; }

}  // namespace limpid::bench
