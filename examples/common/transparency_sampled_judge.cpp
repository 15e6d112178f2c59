// SPDX-License-Identifier: MIT
#include "transparency_findings.hpp"

#include <limpid/design/sampled_wall_interval.hpp>
#include <limpid/design/sampled_wall_proof.hpp>

#include <algorithm>
#include <cmath>

namespace limpid::examples {

namespace {

constexpr double last_part = 1e-4;  // of the interval, left unproved at each end

struct WorstPlant {
  HapticPlant<> plant{};
  double radius = 0;
};

WorstPlant worst_plant(const SampledWall<>& loop, const PlantBox<>& box, const WallFeedback<>& gain) {
  constexpr int along = 16;
  const auto part = [](double from, double to, int i) { return i == along ? to : from + (to - from) * i / along; };
  WorstPlant worst{box.lower, sampled_wall_radius(loop, box.lower, gain)};
  for (int i = 0; i <= along; ++i) {
    for (int j = 0; j <= along; ++j) {
      const HapticPlant<> plant{part(box.lower.mass, box.upper.mass, i), part(box.lower.damping, box.upper.damping, j)};
      const double radius = sampled_wall_radius(loop, plant, gain);
      if (radius > worst.radius) worst = {plant, radius};
    }
  }
  return worst;
}

// The plant of a refutation may lie between those of the grid.
SampledVerdict verdict_of(const TransparencyTask& task, const SampledWall<>& loop, const WallFeedback<>& gain) {
  const PlantBox<> box = task.box();
  const auto proof = prove_sampled_wall(loop, box, gain, task.radius);
  WorstPlant worst = worst_plant(loop, box, gain);
  if (proof.verdict == Verdict::infeasible) {
    const double radius = sampled_wall_radius(loop, proof.plant, gain);
    if (radius > worst.radius) worst = {proof.plant, radius};
  }
  return {gain.B_c, proof.verdict, worst.plant, worst.radius};
}

GainInterval<> widest(const std::vector<GainInterval<>>& intervals) {
  const auto found = std::max_element(intervals.begin(), intervals.end(), [](const auto& a, const auto& b) {
    return a.upper - a.lower < b.upper - b.lower;
  });
  return found == intervals.end() ? GainInterval<>{} : *found;
}

// Robustly stable when sampled, and by (17). Where not every gain that was found is proved, one may be.
std::optional<OfferedGain> offer(const TransparencyTask& task, const TransparencyFindings& findings,
                                 const SampledFindings& sampled, const SampledWall<>& loop) {
  if (sampled.optimum && sampled.optimum->verdict == Verdict::feasible && findings.optimum->norm <= 1) {
    return OfferedGain{*findings.optimum, *sampled.optimum};
  }
  const auto& [lower, upper] = sampled.robust.empty() ? sampled.found : sampled.robust;
  const GainInterval<> both{std::max(lower, findings.robust.lower), std::min(upper, findings.robust.upper)};
  if (both.empty()) return {};
  const GainFigures figures = best_gain(task, findings.K_c, both);
  if (!std::isfinite(figures.index) || !(figures.norm <= 1)) return {};
  const SampledVerdict verdict = verdict_of(task, loop, figures.gain);
  if (verdict.verdict != Verdict::feasible) return {};
  return OfferedGain{figures, verdict};
}

}  // namespace

void judge_sampled(const TransparencyTask& task, TransparencyFindings& findings) {
  for (const VelocitySource velocity : task.velocities) {
    const SampledWall<> loop = task.loop(velocity);
    SampledFindings sampled{.velocity = velocity};
    sampled.nominal = widest(stable_gains(loop, task.problem.plant, findings.K_c, task.radius));
    const auto robust = robust_stable_gains(loop, task.box(), findings.K_c, task.radius, last_part);
    sampled.found = robust.found;
    sampled.robust = robust.proved;
    if (findings.optimum) sampled.optimum = verdict_of(task, loop, findings.optimum->gain);
    for (const double gain : task.gains) sampled.gains.push_back(verdict_of(task, loop, {findings.K_c, gain}));
    sampled.offered = offer(task, findings, sampled, loop);
    findings.sampled.push_back(std::move(sampled));
  }
}

void take_steps(const TransparencyTask& task, TransparencyFindings& findings) {
  if (!task.force) return;
  std::vector<double> gains{task.problem.wall.damping};
  gains.insert(gains.end(), task.gains.begin(), task.gains.end());
  if (findings.optimum) gains.push_back(findings.optimum->gain.B_c);
  for (const SampledFindings& sampled : findings.sampled) {
    if (sampled.offered) gains.push_back(sampled.offered->figures.gain.B_c);
  }
  std::sort(gains.begin(), gains.end());
  gains.erase(std::unique(gains.begin(), gains.end()), gains.end());
  const SampledWall<> loop = task.loop(task.step_velocity);
  for (const double gain : gains) {
    findings.steps.push_back(step_response(loop, task.problem.plant, {findings.K_c, gain}, *task.force));
  }
}

}  // namespace limpid::examples
