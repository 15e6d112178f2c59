// SPDX-License-Identifier: MIT
#include "transparency_findings.hpp"

#include <limpid/design/transparency.hpp>

#include <norm_instances.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid::examples {

namespace {

double index_of(const TransparencyTask& task, double K_c, double B_c) {
  return transparency_index(task.problem, WallFeedback<>{K_c, B_c}).J;
}

// At the end of an interval six digits, kept inside, are what one types.
double rounded_inside(double gain, const GainInterval<>& interval) {
  if (!(gain > 0)) return gain;
  const double unit = std::pow(10.0, std::floor(std::log10(gain)) - 5);
  for (const double rounded :
       {std::round(gain / unit) * unit, std::floor(gain / unit) * unit, std::ceil(gain / unit) * unit}) {
    if (interval.contains(rounded)) return rounded;
  }
  return gain;
}

// Golden section on J: it is flat at its minimum, and half the digits are enough for six.
double least_index_between(const TransparencyTask& task, double K_c, double a, double b) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double left = b - golden * (b - a), right = a + golden * (b - a);
  double J_left = index_of(task, K_c, left), J_right = index_of(task, K_c, right);
  for (int i = 0; i < 40; ++i) {
    if (J_left < J_right) {
      b = right, right = left, J_right = J_left;
      left = b - golden * (b - a);
      J_left = index_of(task, K_c, left);
    } else {
      a = left, left = right, J_left = J_right;
      right = a + golden * (b - a);
      J_right = index_of(task, K_c, right);
    }
  }
  return J_left < J_right ? left : right;
}

}  // namespace

GainFigures figures_of(const TransparencyTask& task, const WallFeedback<>& gain) {
  const auto index = transparency_index(task.problem, gain);
  const auto norm = uncertainty_norm(task.problem, gain);
  return {gain, index.J, norm.norm, norm.frequency};
}

GainFigures best_gain(const TransparencyTask& task, double K_c, const GainInterval<>& interval) {
  constexpr int parts = 32;
  const auto at = [&](int i) {
    return i == parts ? interval.upper : interval.lower + (interval.upper - interval.lower) * i / parts;
  };
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= parts; ++i) {
    const double J = index_of(task, K_c, at(i));
    if (J < least) least = J, best = i;
  }
  double B_c = at(best);
  const double between = least_index_between(task, K_c, at(std::max(0, best - 1)), at(std::min(parts, best + 1)));
  if (index_of(task, K_c, between) < least) B_c = between;
  return figures_of(task, {K_c, rounded_inside(B_c, interval)});
}

void judge_model(const TransparencyTask& task, TransparencyFindings& findings) {
  const auto best = task.free ? free_transparency_optimum(task.problem) : transparency_optimum(task.problem);
  findings.K_c = task.problem.wall.stiffness;
  if (best.index.verdict == NormVerdict::finite) {
    findings.optimum = GainFigures{best.gain, best.index.J, best.norm.norm, best.norm.frequency};
    findings.K_c = best.gain.K_c;
  }
  findings.robust = robust_interval(task.problem, findings.K_c);
  for (const double gain : task.gains) findings.table.push_back(figures_of(task, {findings.K_c, gain}));
}

}  // namespace limpid::examples
