// SPDX-License-Identifier: MIT
// Section 6.1.4: the complete system, Table 6.5.
#include "scene.hpp"
#include "section.hpp"
#include "section_charts.hpp"
#include "stability_regions.hpp"
#include "trace_curve.hpp"

#include <array>
#include <string>

namespace limpid::examples {

namespace {

struct Case {
  int number;
  double stiffness, period;          // N/m, s
  double printed_bound, printed_l2;  // Table 6.5, as fractions
  std::array<double, 2> gain;        // Table 6.4
};

constexpr std::array<double, 2> fast{-441.3, -12.12}, medium{-203.3, -5.15}, slow{-195.1, -4.89};
constexpr std::array<Case, 9> table_6_5{{{1, 200, 0.016, -0.692, -0.397, fast},
                                         {2, 200, 0.032, -0.787, -0.625, medium},
                                         {3, 200, 0.100, -0.839, -0.857, slow},
                                         {4, 800, 0.016, -0.732, -0.389, fast},
                                         {5, 800, 0.032, -0.819, -0.620, medium},
                                         {6, 800, 0.100, -0.873, -0.857, slow},
                                         {7, 1500, 0.016, -0.754, -0.390, fast},
                                         {8, 1500, 0.032, -0.824, -0.619, medium},
                                         {9, 1500, 0.100, -0.871, -0.856, slow}}};

// One setting for all cases: a raised cosine of 4.5 N, 0.5 Hz, 5 s; the tool's spring pulls toward the base frame.
Scene scene_of(const Case& which, double tool_stiffness) {
  Scene scene;
  scene.tissue = {.stiffness = which.stiffness, .damping = 30};
  scene.tool = {.mass = 0.1, .damping = 0.1, .stiffness = tool_stiffness};
  scene.gain.assign(which.gain.begin(), which.gain.end());
  scene.duration = std::chrono::seconds{5};
  scene.force = raised_cosine_force(4.5, 0.5, scene.duration);
  scene.period = scene.delay = from_seconds(which.period);
  scene.spring_at_base = true;
  return scene;
}

struct Pair {
  PalpationResult with, without;
};

Pair run_case(const Case& which, double tool_stiffness) {
  const Scene scene = scene_of(which, tool_stiffness);
  return {palpate(scene, PredictorKind::model), palpate(scene, PredictorKind::hold)};
}

Chart pair_chart(const std::string& title, const Pair& pair, double TracePoint::*error) {
  return error_chart(title, {{"with predictor", pair.with}, {"without", pair.without}}, error);
}

Chart torque_chart(const std::string& title, const PalpationResult& result) {
  Panel panel{"control torque", "time (s)", "N m", {}};
  for (Eigen::Index joint = 0; joint < 3; ++joint) {
    panel.curves.push_back(curve("joint " + std::to_string(joint + 1), result.trace,
                                 [joint](const TracePoint& point) { return point.torque[joint]; }));
  }
  return {title, {panel}};
}

void add_charts(SectionReport& report, const Case& which, const Pair& pair) {
  const std::string figure = std::to_string(17 + which.number), number = std::to_string(which.number);
  report.charts.push_back({"fig_6_" + figure, pair_chart("Fig. 6." + figure + ": total error, case " + number, pair,
                                                         &TracePoint::total_error)});
  if (which.number == 1) {
    report.charts.push_back(
        {"fig_6_16", tracking_chart("Fig. 6.16: end effector, k = 200 N/m, T_d = 0.016 s", pair.with)});
    report.charts.push_back(
        {"fig_6_17", pair_chart("Fig. 6.17: predictor error, case 1", pair, &TracePoint::prediction_error)});
  }
  if (which.number == 9) {
    report.charts.push_back({"fig_6_27", torque_chart("Fig. 6.27: torque with prediction, case 9", pair.with)});
    report.charts.push_back({"fig_6_28", torque_chart("Fig. 6.28: torque without prediction, case 9", pair.without)});
  }
}

void add_case_without_spring(SectionReport& report) {
  const Pair pair = run_case(table_6_5[8], 0);
  report.figures.push_back({"case 9 with k_t = 0: change of the bound",
                            relative_change(pair.with.total.total().max, pair.without.total.total().max), -0.001, "1"});
  report.figures.push_back({"case 9 with k_t = 0: change of the L2 norm",
                            relative_change(pair.with.total.total().l2, pair.without.total.total().l2), -0.07, "1"});
  report.charts.push_back(
      {"fig_6_29", pair_chart("Fig. 6.29: total error, case 9 with k_t = 0", pair, &TracePoint::total_error)});
}

// Table 6.4's last column and Fig. 6.15.
void add_stability_regions(SectionReport& report) {
  const DesignSetting setting{.design = {.tool = {.mass = 0.1, .damping = 0.1, .stiffness = 1}},
                              .nominal = {1100, 30},
                              .rates = {},
                              .grid = thesis_grid(20)};
  for (const Case* which : {&table_6_5[0], &table_6_5[1], &table_6_5[2]}) {
    const bool last = which->period == 0.1;
    add_constant_gain(report, setting, {which->period, {which->gain[0], which->gain[1]}, {}, last ? "6.15" : "", ""},
                      last ? "Table 6.4: not stable over the full range" : "Table 6.4: stable over the full range");
  }
}

}  // namespace

SectionReport section_6_1_4(std::optional<int> number) {
  SectionReport report{.title = "6.1.4 complete system, Table 6.5"};
  for (const Case& which : table_6_5) {
    if (number && *number != which.number) continue;
    const Pair pair = run_case(which, 1);
    report.cases.push_back({which.number, relative_change(pair.with.total.total().max, pair.without.total.total().max),
                            relative_change(pair.with.total.total().l2, pair.without.total.total().l2),
                            which.printed_bound, which.printed_l2});
    add_charts(report, which, pair);
  }
  if (number) return report;
  add_case_without_spring(report);
  add_stability_regions(report);
  return report;
}

}  // namespace limpid::examples
