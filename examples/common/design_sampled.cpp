// SPDX-License-Identifier: MIT
// The exact sampled predictor and the continuous delay system, as `design_gain` asks them.
#include "design_judge.hpp"

#include <limpid/design/delay_stability.hpp>
#include <limpid/design/map.hpp>
#include <limpid/design/sampled_gain.hpp>
#include <limpid/design/sampled_proof.hpp>
#include <limpid/design/sampled_stability.hpp>
#include <limpid/design/sampled_varying.hpp>
#include <limpid/design/sampled_worst.hpp>

#include <algorithm>

namespace limpid::examples {

namespace {

SampledSystem<> system_of(const DesignTask& task) {
  return {.tool = task.design.tool, .period = task.design.T_d, .delay = task.delay};
}

SampledAnswer ask_at_point(const DesignTask& task, const AffineGain<>& gain) {
  const Gain<> L = gain(task.environment);
  return {.radius = sampled_radius(system_of(task), task.environment, L),
          .stable = prove_sampled_stability(system_of(task), task.environment, L).verdict};
}

// With parameters that vary from sample to sample; too large a system is not asked about.
Verdict ask_varying(const DesignTask& task, const Gain<>& L) {
  if (system_of(task).degree() > 6) return Verdict::undecided;
  return prove_varying_stability(system_of(task), task.box, L).verdict;
}

// A gain that depends on the tissue is judged on a grid: the proof over cells is for one gain.
SampledAnswer ask_schedule(const DesignTask& task, const AffineGain<>& gain) {
  SampledAnswer answer{.radius = 0, .on_grid = true};
  const SampledStability<> stability(system_of(task));
  const Grid<> grid = grid_over(task.box);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    answer.radius = std::max(answer.radius, stability.radius(grid[i], gain(grid[i])));
  }
  answer.stable = answer.radius < 1 ? Verdict::undecided : Verdict::infeasible;
  return answer;
}

}  // namespace

Grid<> grid_over(const TissueBox<>& box) {
  const auto side = [](double lower, double upper, int steps) {
    return lower < upper ? GridSide<>{lower, (upper - lower) / steps, upper} : GridSide<>{lower, 1, upper};
  };
  return {side(box.lower.stiffness, box.upper.stiffness, 18), side(box.lower.damping, box.upper.damping, 20)};
}

SampledAnswer ask_sampled(const DesignTask& task, const AffineGain<>& gain) {
  if (!task.over_box) return ask_at_point(task, gain);
  if (is_scheduled(gain)) return ask_schedule(task, gain);
  const WorstRadius<> worst = worst_sampled_radius(system_of(task), task.box, gain.L0);
  SampledAnswer answer{.radius = worst.proof.proved() ? worst.proved : worst.found};
  answer.stable = prove_sampled_stability(system_of(task), task.box, gain.L0).verdict;
  answer.varying = ask_varying(task, gain.L0);
  return answer;
}

DelayAnswer ask_delay(const DesignTask& task, const AffineGain<>& gain) {
  DelayAnswer answer;
  const DelaySystem<> system{.tool = task.design.tool, .delay = task.design.T_d};
  const Grid<> grid = grid_over(task.over_box ? task.box : TissueBox<>{task.environment, task.environment});
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const auto root = rightmost_delay_root(system, grid[i], gain(grid[i]));
    if (i == 0 || root.real() > answer.root.real()) answer.root = root;
  }
  answer.root = without_rounding(answer.root);
  answer.stable = answer.root.real() < 0;
  return answer;
}

RobustAnswer ask_robust(const DesignTask& task) {
  RobustAnswer answer;
  WorstRadius<> worst;
  if (task.gain) {
    answer.gain = *task.gain;
    worst = worst_sampled_radius(system_of(task), task.box, task.gain->L0);
  } else {
    const RobustSampledGain<> found = robust_sampled_gain(system_of(task), task.box);
    answer.gain.L0 = found.gain;
    worst = found.worst;
  }
  answer.worst_radius = worst.proof.proved() ? worst.proved : worst.found;
  answer.worst = worst.tissue;
  answer.proved = worst.proof.proved();
  answer.reason = worst.proof.reason;
  answer.varying = ask_varying(task, answer.gain.L0);
  return answer;
}

InequalityAnswer ask_for_sampled_gain(const DesignTask& task) {
  InequalityAnswer answer;
  const SampledGain<> found = smallest_sampled_radius(system_of(task), task.environment);
  answer.gain = AffineGain<>{.L0 = found.gain};
  answer.verdict = prove_sampled_stability(system_of(task), task.environment, found.gain).verdict;
  answer.certified = answer.verdict != Verdict::undecided;
  answer.reason = "the radius is too close to 1 to tell";
  return answer;
}

}  // namespace limpid::examples
