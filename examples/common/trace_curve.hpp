// SPDX-License-Identifier: MIT
#pragma once

#include "chart.hpp"
#include "scene.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace limpid::examples {

/// One signal of a trace as a curve of at most some 2000 points; peaks between them are kept.
template <typename Signal>
[[nodiscard]] Curve curve(std::string name, const std::vector<TracePoint>& trace, Signal signal) {
  Curve result{std::move(name), {}, {}};
  const std::size_t stride = std::max<std::size_t>(1, trace.size() / 1000);
  for (std::size_t begin = 0; begin < trace.size(); begin += stride) {
    const auto first = trace.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = trace.begin() + static_cast<std::ptrdiff_t>(std::min(begin + stride, trace.size()));
    const auto by_value = [&](const TracePoint& a, const TracePoint& b) {
      return std::invoke(signal, a) < std::invoke(signal, b);
    };
    auto [low, high] = std::minmax_element(first, last, by_value);
    if (high < low) std::swap(low, high);
    for (const auto at : {low, high}) {
      result.x.push_back(at->time);
      result.y.push_back(std::invoke(signal, *at));
      if (low == high) break;
    }
  }
  return result;
}

}  // namespace limpid::examples
