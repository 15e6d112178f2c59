// SPDX-License-Identifier: MIT
#include "time_error/timing.hpp"

#include <chrono>
#include <cmath>
#include <cstddef>

namespace limpid::bench {

namespace {

constexpr double turn_ns = 20e3;  // long for the clock, short for the scheduler

double quantile(std::vector<double> values, double p) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(p * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double ns_of(const Method& method, long steps) {
  const auto start = std::chrono::steady_clock::now();
  method.run(steps);
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

long steps_of_a_turn(const Method& method) {
  long steps = 1;
  while (ns_of(method, steps) < turn_ns) steps *= 2;
  return steps;
}

std::size_t default_in(const std::vector<Method>& methods, const std::string& scalar) {
  std::size_t i = 0;
  while (i < methods.size() && !(methods[i].is_default && methods[i].scalar == scalar)) ++i;
  return i;
}

}  // namespace

std::vector<Timing> time_in_turns(std::vector<Method>& methods, int turns) {
  std::vector<long> steps;
  for (const Method& method : methods) steps.push_back(steps_of_a_turn(method));
  std::vector<std::vector<double>> ns(methods.size());
  for (int turn = 0; turn < turns; ++turn) {
    for (std::size_t i = 0; i < methods.size(); ++i) {
      ns[i].push_back(ns_of(methods[i], steps[i]) / static_cast<double>(steps[i]));
    }
  }
  std::vector<Timing> timings;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const std::size_t reference = default_in(methods, methods[i].scalar);
    std::vector<double> ratios(ns[i].size(), std::nan(""));
    if (reference < methods.size()) {
      for (std::size_t turn = 0; turn < ratios.size(); ++turn) ratios[turn] = ns[i][turn] / ns[reference][turn];
    }
    timings.push_back({quantile(ns[i], 0.5), quantile(ratios, 0.5), quantile(ratios, 0.25), quantile(ratios, 0.75)});
  }
  return timings;
}

}  // namespace limpid::bench
