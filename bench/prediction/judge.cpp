// SPDX-License-Identifier: MIT
#include "prediction/judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid::bench {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double least_judged = 0.01;  // of hold's mean error

std::size_t tick_at(double seconds) { return static_cast<std::size_t>(std::llround(seconds / tick_seconds)); }

// Over the ticks [begin, end).
double error(const Truth& truth, const Trace& trace, std::size_t begin, std::size_t end) {
  double sum = 0;
  for (std::size_t k = begin; k < end; ++k) {
    const double x = trace[k].x - truth.ticks[k].tool.x, v = trace[k].v - truth.ticks[k].tool.v;
    sum += (x * x + v * v) * tick_seconds;
  }
  return std::sqrt(sum);
}

double over(double error, double hold) {
  if (!(hold > 0)) return nothing;
  return std::isfinite(error) ? error / hold : std::numeric_limits<double>::infinity();
}

}  // namespace

Figures judge(const Truth& truth, const Trace& trace, const Trace& hold, double late_from) {
  const std::size_t length = tick_at(window_seconds), count = (truth.ticks.size() - 1) / length;
  Figures figures{.early = nothing, .late = nothing, .worst = nothing, .windows = {}};
  double mean = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = i * length, end = begin + length;
    const double of_hold = error(truth, hold, begin, end);
    mean += of_hold / static_cast<double>(count);
    figures.windows.push_back(
        {static_cast<double>(i) * window_seconds, over(error(truth, trace, begin, end), of_hold), of_hold});
  }
  for (Window& window : figures.windows) {
    window.judged = window.hold_error > 0 && window.hold_error >= least_judged * mean;
    if (window.judged) figures.worst = std::fmax(figures.worst, window.ratio);
  }
  const std::size_t end = count * length, late = std::min(tick_at(late_from), end);
  if (!figures.windows.empty() && figures.windows.front().judged) figures.early = figures.windows.front().ratio;
  figures.late = over(error(truth, trace, late, end), error(truth, hold, late, end));
  return figures;
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  int count = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += std::log(std::max(value, 1e-9));
    ++count;
  }
  return count > 0 ? std::exp(sum / count) : nothing;
}

}  // namespace limpid::bench
