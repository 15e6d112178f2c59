// SPDX-License-Identifier: MIT
#include "chart.hpp"
#include "transparency_findings.hpp"
#include "words.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <limits>

namespace limpid::examples {

namespace {

// rad/s, from far below the wall's corner and the weight's to the Nyquist frequency
std::vector<double> frequencies_of(const TransparencyTask& task) {
  constexpr int points = 600;
  const double to = std::acos(-1.0) / task.problem.period;
  const auto& [K, B] = task.problem.wall;
  const double from = std::min({to, task.weight, std::sqrt(K / task.problem.plant.mass)}) / 100;
  std::vector<double> frequencies;
  for (int i = 0; i <= points; ++i) frequencies.push_back(from * std::pow(to / from, double(i) / points));
  return frequencies;
}

template <typename Admittance>
Curve admittance_curve(const std::string& name, const std::vector<double>& frequencies, const Admittance& Y) {
  Curve curve{name, {}, {}};
  for (const double omega : frequencies) {
    const double dB = 20 * std::log10(std::abs(Y(omega)));
    if (!std::isfinite(dB)) continue;  // on a pole
    curve.x.push_back(omega);
    curve.y.push_back(dB);
  }
  return curve;
}

// Of the wall, and through feedback with each of these gains.
Chart admittances(const TransparencyTask& task, double K_c, const std::string& title,
                  const std::vector<double>& gains) {
  const auto frequencies = frequencies_of(task);
  Panel panel{"admittance", "frequency (rad/s)", "|Y| (dB of m/(N s))", {}, false, true};
  panel.curves.push_back(
      admittance_curve("wall", frequencies, [&](double omega) { return wall_admittance(task.problem.wall, omega); }));
  panel.curves.back().dashed = true;
  for (const double B_c : gains) {
    panel.curves.push_back(admittance_curve(words("felt, B_c = %.5g", B_c), frequencies, [&](double omega) {
      return transmitted_admittance(task.problem, WallFeedback<>{K_c, B_c}, omega);
    }));
  }
  return {title, {panel}};
}

Chart index_and_norm(const TransparencyTask& task, const TransparencyFindings& findings) {
  constexpr int points = 120;
  double to = findings.optimum ? 2 * findings.optimum->gain.B_c : 0;
  const double least = findings.optimum ? findings.optimum->index : std::numeric_limits<double>::infinity();
  for (const double gain : task.gains) to = std::max(to, 1.2 * gain);
  Curve J{"J", {}, {}}, norm{"||L||", {}, {}}, one{"1", {}, {}, true};
  for (int i = 1; i <= points; ++i) {
    const GainFigures at = figures_of(task, {findings.K_c, to * i / points});
    if (!std::isfinite(at.index) || !std::isfinite(at.norm)) continue;
    for (Curve* curve : {&norm, &one}) curve->x.push_back(at.gain.B_c);
    norm.y.push_back(at.norm);
    one.y.push_back(1);
    if (at.index > 3 * least) continue;  // it would flatten the rest
    J.x.push_back(at.gain.B_c);
    J.y.push_back(at.index);
  }
  return {"performance index and ||L|| over B_c, Fig. 8",
          {{"performance index (11)", "B_c (N s/m)", "J", {J}},
           {"robust stability (17)", "B_c (N s/m)", "||L||", {norm, one}, true}}};
}

Chart responses(const std::string& title, const std::vector<const StepResponse*>& steps) {
  Chart chart{title, {{"force of the device", "time (s)", "F_d (N)", {}}, {"position", "time (s)", "x (mm)", {}}}};
  for (const StepResponse* step : steps) {
    const std::string name = words("B_c = %.5g", step->gain);
    Curve position{name, step->time, step->position};
    for (double& x : position.y) x *= 1e3;
    chart.panels[0].curves.push_back({name, step->time, step->force});
    chart.panels[1].curves.push_back(std::move(position));
  }
  return chart;
}

std::vector<const StepResponse*> steps_with(const TransparencyFindings& findings, const std::vector<double>& gains) {
  std::vector<const StepResponse*> steps;
  for (const double gain : gains) {
    for (const StepResponse& step : findings.steps) {
      if (step.gain == gain) steps.push_back(&step);
    }
  }
  return steps;
}

// The optimum, and what is offered in its place.
std::vector<double> proposed_gains(const TransparencyFindings& findings) {
  std::vector<double> gains;
  const auto add = [&](double gain) {
    if (std::find(gains.begin(), gains.end(), gain) == gains.end()) gains.push_back(gain);
  };
  if (findings.optimum) add(findings.optimum->gain.B_c);
  for (const SampledFindings& sampled : findings.sampled) {
    if (sampled.offered) add(sampled.offered->figures.gain.B_c);
  }
  return gains;
}

}  // namespace

std::vector<std::string> draw_figures(const TransparencyTask& task, const TransparencyFindings& findings,
                                      const std::string& folder) {
  std::vector<std::string> paths;
  const auto add = [&](const char* name, const Chart& chart) {
    for (const Panel& panel : chart.panels) {
      if (panel.curves.empty() || panel.curves.front().x.empty()) return;
    }
    paths.push_back(draw(chart, (std::filesystem::path(folder) / (std::string(name) + ".svg")).string()));
  };
  const double B = task.problem.wall.damping, K = task.problem.wall.stiffness;
  const std::vector<double> proposed = proposed_gains(findings);
  std::vector<double> all{B};
  all.insert(all.end(), proposed.begin(), proposed.end());
  add("figure_4", admittances(task, K, "typical admittance plot, Fig. 4: the wall itself as the feedback", {B}));
  add("figure_8", index_and_norm(task, findings));
  add("figure_9", admittances(task, findings.K_c, "admittance response, Fig. 9", all));
  if (!task.force) return paths;
  add("figure_7", responses("the wall itself as the feedback, Fig. 7", steps_with(findings, {B})));
  add("figure_10", responses("optimum, and robustly stable gains, Fig. 10", steps_with(findings, proposed)));
  return paths;
}

}  // namespace limpid::examples
