// SPDX-License-Identifier: MIT
#include "prediction/trace.hpp"

#include <algorithm>
#include <limits>

namespace limpid::bench {

namespace {

constexpr int steps_a_tick = 4;

}  // namespace

Trace floor_trace(const Course& course, const Tissue& tissue, const TissueChange& change) {
  const auto& ticks = course.truth.ticks;
  ToolInTissue known(TissueForce(tissue.force(), change, std::numeric_limits<double>::infinity()), tool());
  const auto advance = [&](ToolInTissue::State& s, std::size_t k) {
    known.advance(s, static_cast<double>(k) * tick_seconds, tick_seconds, ticks[k].F_h, ticks[k + 1].F_h, steps_a_tick);
  };
  Trace trace(ticks.size());
  ToolInTissue::State s;
  double lower = 0, upper = 0;
  auto next = course.samples.begin();
  for (std::size_t now = 0; now < ticks.size(); ++now) {
    const auto first = next;
    for (; next != course.samples.end() && next->arrived <= now; ++next) {
      lower = std::min(lower, ticks[next->taken].tool.x);
      upper = std::max(upper, ticks[next->taken].tool.x);
    }
    if (next != first) {
      const std::size_t taken = std::prev(next)->taken;
      if (static_cast<double>(taken) * tick_seconds >= course.truth.step_shows) {
        known.tissue().steps_at(course.truth.step_at);
      }
      known.tissue().know(lower, upper);
      s = ticks[taken].tool;
      for (std::size_t k = taken; k < now; ++k) advance(s, k);
    } else if (next != course.samples.begin()) {
      advance(s, now - 1);
    }
    trace[now] = {s.x, s.v};
  }
  return trace;
}

}  // namespace limpid::bench
