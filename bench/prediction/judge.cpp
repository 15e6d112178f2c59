// SPDX-License-Identifier: MIT
#include "prediction/judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid::bench {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::size_t tick_at(double seconds) { return static_cast<std::size_t>(std::llround(seconds / tick_seconds)); }

std::vector<double> squared_errors(const Truth& truth, const Trace& trace) {
  std::vector<double> squares;
  squares.reserve(trace.size());
  for (std::size_t k = 0; k < trace.size(); ++k) {
    const double x = trace[k].x - truth.ticks[k].tool.x, v = trace[k].v - truth.ticks[k].tool.v;
    squares.push_back(x * x + v * v);
  }
  return squares;
}

}  // namespace

Figures judge(const Truth& truth, const Trace& trace, const Trace& hold, double late_from) {
  const std::vector<double> squares = squared_errors(truth, trace), of_hold = squared_errors(truth, hold);
  Figures figures{.early = nothing,
                  .late = nothing,
                  .worst = nothing,
                  .windows = examples::windows_of(squares, of_hold, tick_seconds)};
  for (const Window& window : figures.windows) {
    if (window.judged) figures.worst = std::fmax(figures.worst, window.ratio);
  }
  if (!figures.windows.empty() && figures.windows.front().judged) figures.early = figures.windows.front().ratio;
  const std::size_t end = figures.windows.size() * tick_at(window_seconds), late = std::min(tick_at(late_from), end);
  const auto late_error = [&](const std::vector<double>& of) { return examples::l2(of, late, end, tick_seconds); };
  figures.late = examples::over_hold(late_error(squares), late_error(of_hold));
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
