// SPDX-License-Identifier: MIT
#include "windows.hpp"

#include <cmath>
#include <limits>

namespace limpid::examples {

namespace {

constexpr double least_judged = 0.01;  // of hold's mean error

}  // namespace

double l2(const std::vector<double>& squares, std::size_t begin, std::size_t end, double tick) {
  double sum = 0;
  for (std::size_t k = begin; k < end; ++k) sum += squares[k] * tick;
  return std::sqrt(sum);
}

double over_hold(double error, double hold) {
  if (!(hold > 0)) return std::numeric_limits<double>::quiet_NaN();
  return std::isfinite(error) ? error / hold : std::numeric_limits<double>::infinity();
}

std::vector<Window> windows_of(const std::vector<double>& squares, const std::vector<double>& of_hold, double tick) {
  const auto length = static_cast<std::size_t>(std::llround(window_seconds / tick));
  const std::size_t count = (squares.size() - 1) / length;
  std::vector<Window> windows;
  double mean = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = i * length, end = begin + length;
    const double hold = l2(of_hold, begin, end, tick);
    mean += hold / static_cast<double>(count);
    windows.push_back({static_cast<double>(i) * window_seconds, over_hold(l2(squares, begin, end, tick), hold), hold});
  }
  for (Window& window : windows) window.judged = window.hold_error > 0 && window.hold_error >= least_judged * mean;
  return windows;
}

}  // namespace limpid::examples
