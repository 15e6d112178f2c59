// SPDX-License-Identifier: MIT
#include "prediction/truth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limpid::bench {

namespace {

constexpr int steps_a_tick = 20;

constexpr double rest = 0.7;  // s, before half time and after it

// Zero around half time, and softly to one within half a second.
double rest_around(double half_time, double t) {
  const double away = std::abs(t - half_time), part = (away - rest) / 0.5;
  return part < 0 ? 0 : part < 1 ? 0.5 * (1 - std::cos(std::numbers::pi * part)) : 1;
}

}  // namespace

Truth simulate(const Tissue& tissue, const Force& force, const TissueChange& change, double seconds, bool idle) {
  Truth truth{.ticks = {}, .step_at = seconds / 2, .step_shows = seconds / 2 + (idle ? rest : 0)};
  const ToolInTissue pressed_tool(TissueForce(tissue.force(), change, truth.step_at), tool());
  const auto pressed = [&](double t) {
    const double F_h = force.at(t) * (idle ? rest_around(truth.step_at, t) : 1);
    return tissue.edge ? std::max(F_h, 0.0) : F_h;
  };
  const auto count = std::llround(seconds / tick_seconds);
  ToolInTissue::State s;
  double F_h = pressed(0);
  truth.ticks.reserve(static_cast<std::size_t>(count + 1));
  truth.ticks.push_back({s, F_h, pressed_tool.force(s, 0, F_h)});
  for (long long k = 0; k < count; ++k) {
    const double begin = static_cast<double>(k) * tick_seconds, end = static_cast<double>(k + 1) * tick_seconds;
    const double next = pressed(end);
    pressed_tool.advance(s, begin, tick_seconds, F_h, next, steps_a_tick);
    F_h = next;
    truth.ticks.push_back({s, F_h, pressed_tool.force(s, end, F_h)});
  }
  return truth;
}

}  // namespace limpid::bench
