// SPDX-License-Identifier: MIT
// Sections 6.1.1 to 6.1.3: the predictor without a robot, with the printed gains.
#include "design_instances.hpp"
#include "design_judge.hpp"
#include "figure_6_1.hpp"
#include "prediction_study.hpp"
#include "section.hpp"
#include "study_curve.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace limpid::examples {

namespace {

constexpr Duration sixtieth{16'666'667};                              // T = 1/60 s, nanoseconds
constexpr Duration near_continuous = std::chrono::microseconds{100};  // the thesis simulates in continuous time

double sine_press(double t) { return 3 * std::sin(std::numbers::pi * t); }  // 6.1.2, misprint corrected

double mean_position_error(const PredictionStudy& study) {
  double sum = 0;
  for (const StudyPoint& point : run(study)) sum += point.x_predicted - point.x;
  return sum;
}

PredictionStudy delayed_study(bool error_in_history) {
  PredictionStudy study{.stiffness = 2000, .damping = 45, .gain_position = -753.2, .gain_velocity = -17.01};
  study.period = study.tick = near_continuous;  // delayed, not sampled: fresh on every tick
  study.delay = sixtieth;
  study.x0_predicted = 0.01;
  study.error_in_history = error_in_history;
  return study;
}

// Table 6.2.
PredictionStudy sampled_study(double stiffness) {
  PredictionStudy study{.stiffness = stiffness, .damping = 25, .gain_position = -574.1, .gain_velocity = -7.260};
  study.period = study.delay = sixtieth;
  study.tick = near_continuous;
  study.duration = std::chrono::seconds{3};
  study.x0 = 0.001;
  study.force = sine_press;
  return study;
}

// Table 6.3.
PredictionStudy unknown_study(double stiffness, double damping, PredictionStudy::Start start) {
  PredictionStudy study{.stiffness = stiffness, .damping = damping, .gain_position = -430.6, .gain_velocity = -11.83};
  study.start = start;
  study.period = study.delay = sixtieth;
  study.tick = near_continuous;
  study.duration = std::chrono::seconds{2};
  study.force = sine_press;
  return study;
}

double peak_ratio(const std::vector<StudyPoint>& points) {
  return largest(points, &StudyPoint::prediction_error) / largest(points, &StudyPoint::hold_error);
}

void add_unknown_case(SectionReport& report, const std::string& name, const PredictionStudy& study,
                      const std::array<std::string, 3>& files) {
  const auto points = run(study);
  report.figures.push_back(
      {name + ": k within 5 % after", settling_time(points, &StudyPoint::stiffness, study.stiffness, 0.05), {}, "s"});
  report.figures.push_back(
      {name + ": b within 5 % after", settling_time(points, &StudyPoint::damping, study.damping, 0.05), {}, "s"});
  report.figures.push_back({name + ": largest error over hold's", peak_ratio(points), {}, "1"});
  report.charts.push_back({files[0], {name + ": states of the virtual tool", state_panels(points)}});
  report.charts.push_back({files[1], {name + ": errors", error_panels(points)}});
  report.charts.push_back(
      {files[2],
       {name + ": estimated parameters",
        {{"stiffness", "time (s)", "k (N/m)", {curve("estimated", points, &StudyPoint::stiffness)}},
         {"damping", "time (s)", "b (N s/m)", {curve("estimated", points, &StudyPoint::damping)}}}}});
}

// gamma scales the whole inequality (4.31): one gain serves every gamma, and neither the error nor the best bound
// depends on it.
Curve flat_curve(const std::string& name, double value) {
  Curve flat{name, {}, {}};
  for (double gamma = 10; gamma <= 1000; gamma += 10) {
    flat.x.push_back(gamma);
    flat.y.push_back(value);
  }
  return flat;
}

Chart gamma_chart(const std::string& title, double ratio) {
  return {title + "; Theorem 3 is feasible with one L for all gamma",
          {{"largest error over hold's", "gamma", "ratio", {flat_curve("printed gain", ratio)}}}};
}

// Fig. 6.7: what (4.32) guarantees, with the best variables and not those at which a solver ended.
void add_error_bounds(SectionReport& report) {
  const PredictorDesign<> design{.tool = sampled_study(2000).tool, .T_d = 1.0 / 60};
  const Gain<> L(-574.1, -7.260);
  const double printed = error_bound(design, {2000, 25}, L, true), tight = error_bound(design, {2000, 25}, L, false);
  report.figures.push_back({"Fig. 6.7: bound (4.32) of |e| over |Delta_T|, as printed",
                            printed,
                            {},
                            "1",
                            "the same for every gamma; the thesis's variables: on the order of 1e5"});
  report.figures.push_back({"Fig. 6.7: the same with gamma B for gamma I", tight, {}, "1", "as linear, and tighter"});
  report.charts.push_back({"fig_6_7",
                           {"Fig. 6.7: guaranteed error over that of sampling, k = 2000 N/m",
                            {{"bound (4.32)",
                              "gamma",
                              "ratio",
                              {flat_curve("as printed", printed), flat_curve("with gamma B", tight)},
                              true}}}});
}

}  // namespace

SectionReport section_6_1_1() {
  SectionReport report{.title = "6.1.1 known linear environment with delay"};
  for (const bool in_history : {true, false}) {
    const PredictionStudy with = delayed_study(in_history);
    PredictionStudy without = with;
    without.gain_position = without.gain_velocity = 0;
    report.figures.push_back({std::string("mean position error over no feedback, ") +
                                  (in_history ? "initial error as history" : "zero history"),
                              mean_position_error(with) / mean_position_error(without),
                              {},
                              "1",
                              "Fig. 6.1 shows a local minimum below 1 at this gain"});
  }
  const auto points = run(delayed_study(true));
  report.charts.push_back({"fig_6_2",
                           {"Fig. 6.2: predictor error, L = [-753.2 -17.01]",
                            {{"position error",
                              "time (s)",
                              "m",
                              {curve("x", points, [](const StudyPoint& p) { return p.x_predicted - p.x; })}},
                             {"velocity error", "time (s)", "m/s", {curve("v", points, [](const StudyPoint& p) {
                                return p.v_predicted - p.v;
                              })}}}}});
  add_figure_6_1(report);
  return report;
}

SectionReport section_6_1_2() {
  SectionReport report{.title = "6.1.2 known linear environment with delay and sampling"};
  const auto stiff = run(sampled_study(2000)), soft = run(sampled_study(200));
  report.figures.push_back({"hold's error, settled amplitude", largest(stiff, &StudyPoint::hold_error, 1.0), 5e-4,
                            "m, m/s", "printed: around 5e-4"});
  report.figures.push_back({"predictor's error after 1 s", largest(stiff, &StudyPoint::prediction_error, 1.0), 0.0,
                            "m, m/s", "printed: approaches zero"});
  report.figures.push_back({"largest error over hold's, k = 2000", peak_ratio(stiff), {}, "1"});
  report.figures.push_back({"largest error over hold's, k = 200", peak_ratio(soft), {}, "1"});
  report.charts.push_back({"fig_6_3", {"Fig. 6.3: virtual tool, k = 2000 N/m", state_panels(stiff)}});
  report.charts.push_back({"fig_6_4", {"Fig. 6.4: errors, k = 2000 N/m", error_panels(stiff)}});
  report.charts.push_back({"fig_6_5", {"Fig. 6.5: errors, k = 200 N/m", error_panels(soft)}});
  report.charts.push_back({"fig_6_6", gamma_chart("Fig. 6.6: k = 2000 N/m", peak_ratio(stiff))});
  add_error_bounds(report);
  report.charts.push_back({"fig_6_8", gamma_chart("Fig. 6.8: k = 200 N/m", peak_ratio(soft))});
  return report;
}

SectionReport section_6_1_3() {
  SectionReport report{.title = "6.1.3 unknown linear environment with delay and sampling"};
  add_unknown_case(report, "worst case", unknown_study(2000, 40, {200, 20}), {"fig_6_9", "fig_6_10", "fig_6_11"});
  add_unknown_case(report, "typical case", unknown_study(1500, 35, {1100, 30}), {"fig_6_12", "fig_6_13", "fig_6_14"});
  return report;
}

}  // namespace limpid::examples
