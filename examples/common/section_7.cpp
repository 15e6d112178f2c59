// SPDX-License-Identifier: MIT
// Sections 7.1 and 7.2: the experiments on the realistic simulated Omni, with the printed gains.
#include "section_runs.hpp"
#include "words.hpp"

#include <array>
#include <cstddef>
#include <numbers>

namespace limpid::examples {

namespace {

// Table 7.1.
constexpr double tool_mass = 0.5, tool_damping = 0.1;  // kg, N s/m
PredictorDesign<> experiment() { return {.tool = {.mass = tool_mass, .damping = tool_damping, .stiffness = 0}}; }

// Table 7.2; cases 10, 11 and 12 of 7.1.2 have the gains of 7.1.1.
const std::vector<PrintedDesign> table_7_2{{0.016, {-241.94, -8.50}, {}, "7.13", ""},
                                           {0.032, {-144.47, -2.01}, {}, "7.14", ""},
                                           {0.100, {-108.75, -1.44}, {}, "7.15", ""}};

// Table 7.5.
const std::vector<PrintedDesign> table_7_5{
    {0.016, {-466.4, -9.13}, {{-3.3e-5, -2.0e-6}, {-2.6e-2, -1.6e-3}, {-1.1e-3, -4.1e-5}}, "7.21", "7.20"},
    {0.032, {-344.5, -3.54}, {{8.6e-6, 4.7e-7}, {1.1e-2, 1.7e-3}, {-1.2e-4, 3.3e-5}}, "7.23", "7.22"},
    {0.100, {-236.6, -2.37}, {{1.4e-6, 2.8e-6}, {-2.5e-3, 4.7e-3}, {1.1e-4, 4.2e-5}}, "7.25", "7.24"},
    {0.200, {-265.7, -2.54}, {{2.6e-5, 6.8e-6}, {1.7e-3, 5.6e-3}, {-1.2e-4, 1.6e-4}}, "7.27", "7.26"}};

// Table 7.3, and Table 7.4 in its last row, by stiffness and period.
const std::array<std::array<PrintedChange, 3>, 4> tables_7_3_and_7_4{
    {{{{0.0033, 0.131, 0.0007}, {-0.0093, -0.264, -0.074}, {-0.0598, -0.685, -0.420}}},
     {{{-0.0027, -0.134, -0.040}, {-0.0051, -0.241, -0.071}, {-0.0148, -0.492, -0.197}}},
     {{{-0.0014, -0.088, -0.012}, {-0.0025, -0.159, -0.059}, {-0.0042, -0.241, -0.104}}},
     {{{0.0125, 0.620, -0.077}, {0.0062, 0.198, -0.097}, {-0.0297, -0.530, -0.322}}}}};

// Table 7.6, by tissue and period.
const std::array<std::array<PrintedChange, 4>, 2> table_7_6{
    {{{{-0.00258, -0.271, -0.0162, "negligible"},
       {-0.00308, -0.305, -0.0348, "worse, by 22 % in L2"},
       {-0.00224, -0.249, -0.0467, "negligible"},
       {0.00213, 0.210, -0.0206, "better, by 12 % of the bound"}}},
     {{{-0.00062, -0.0532, -0.0496, "negligible"},
       {-0.00231, -0.156, -0.0904, "negligible"},
       {-0.00228, -0.141, -0.0556, "negligible"},
       {0.05135, 3.184, 0.0181, "negligible"}}}}};

std::vector<std::string> notes(const PressForce& press, double peak) {
  return {
      "nothing ran on hardware: the experiments' arm is the realistic simulated Omni, with torque limits, static "
      "friction, encoder steps and the velocity filter (5.3)",
      "operator's force: " + press.description + words(", scaled to a peak of %g N, played back: ", peak) +
          "it acts on the tissue and the predictor, not on the arm (7.1)",
      "the printed numbers are of a hand's force that is not known (Fig. 7.1) and of one device: they cannot be the "
      "same here"};
}

// The controller ran at 500 Hz.
Scene experiment_of(const PressForce& press, double period) {
  Scene scene;
  scene.tool = {.mass = tool_mass, .damping = tool_damping, .stiffness = 0};
  scene.force = press;
  scene.duration = press.duration;
  scene.tick = std::chrono::milliseconds{2};
  scene.period = scene.delay = from_seconds(period);
  scene.robot = RobotKind::realistic;
  scene.start = {0, std::numbers::pi / 4, -1.5};  // 10 N on 200 N/m, 50 mm, end inside the reach of 0.26 m
  scene.playback = true;
  scene.estimation.least_damping = 1;  // the box of 7.2
  return scene;
}

RunCase case_of_7_1(const PressForce& press, std::size_t tissue, std::size_t period) {
  constexpr std::array<double, 3> stiffness{200, 800, 1500};  // N/m
  const PrintedDesign& design = table_7_2[period];
  RunCase which{.name = std::to_string(3 * tissue + period + 1),
                .scene = experiment_of(press, design.T_d),
                .constant = constant_gain(design),
                .printed = tables_7_3_and_7_4[tissue][period]};
  which.scene.estimation = {
      .stiffness = 600, .damping = 20, .linear = true, .least_damping = 1, .damping_gain = 2.67e6, .forgetting = 1};
  const bool linear = tissue < stiffness.size();
  which.scene.tissue = linear ? Tissue{.stiffness = stiffness[tissue], .damping = 30}
                              : Tissue{.kind = TissueKind::hunt_crossley, .stiffness = 1500, .damping = 30};
  which.total_figure = "7." + std::to_string((linear ? 3 : 7) + 3 * tissue + period + 1);
  if (which.name == "9") which.prediction_figure = "7.2";
  return which;
}

void add_runs_of_7_1(SectionReport& report, const PressForce& press) {
  for (std::size_t tissue = 0; tissue < tables_7_3_and_7_4.size(); ++tissue) {
    for (std::size_t period = 0; period < table_7_2.size(); ++period) {
      const RunCase which = case_of_7_1(press, tissue, period);
      const CaseResult result = add_case(report, which);
      if (which.name == "3") {
        report.charts.push_back({"fig_7_3", tracking_chart("Fig. 7.3: end effector, case 3", result.constant)});
      }
      if (which.name == "12") {
        report.charts.push_back({"fig_7_16", parameter_chart("Fig. 7.16: estimated parameters, case 12",
                                                             result.constant, secant_curves(which.scene.tissue))});
      }
    }
  }
}

RunCase case_of_7_2(const PressForce& press, std::size_t tissue, std::size_t period) {
  const PrintedDesign& design = table_7_5[period];
  RunCase which{.name = (tissue == 0 ? "A" : "B") + std::to_string(period + 1),
                .scene = experiment_of(press, design.T_d),
                .constant = constant_gain(design),
                .scheduled = scheduled_gain(design),
                .printed = table_7_6[tissue][period]};
  which.scene.tissue = bilinear_tissue(tissue == 0);
  which.scene.estimation.least_offset = -10.26;
  const std::size_t figure = 28 + 8 * tissue + 2 * period;
  which.prediction_figure = "7." + std::to_string(figure);
  which.total_figure = "7." + std::to_string(figure + 1);
  return which;
}

}  // namespace

SectionReport section_7_1(const PressForce& press, double peak) {
  SectionReport report{.title = "7.1 experiments with the constant gain, Tables 7.3 and 7.4, in simulation",
                       .notes = notes(press, peak)};
  add_runs_of_7_1(report, scaled_to_peak(press, peak));
  const DesignSetting setting{.design = experiment(), .nominal = {600, 20}, .rates = {}, .grid = thesis_grid(1)};
  for (const PrintedDesign& printed : table_7_2) {
    add_constant_gain(report, setting, printed, "the text: quite small, larger as the sampling time increases");
  }
  return report;
}

SectionReport section_7_2(const PressForce& press, double peak) {
  SectionReport report{.title = "7.2 experiments with the gain-scheduled predictor, Table 7.6, in simulation",
                       .notes = notes(press, peak)};
  const PressForce scaled = scaled_to_peak(press, peak);
  report.notes.push_back(
      "by the printed numbers hold's largest total error was 0.009 to 0.016, less than in 7.1: their force was smaller "
      "or slower than a press of 10 N here");
  for (std::size_t tissue = 0; tissue < table_7_6.size(); ++tissue) {
    for (std::size_t period = 0; period < table_7_5.size(); ++period) {
      (void)add_case(report, case_of_7_2(scaled, tissue, period));
    }
  }
  const DesignSetting setting{
      .design = experiment(), .nominal = {1100, 20.5}, .rates = {1.8e5, 3900}, .grid = thesis_grid(1)};
  const std::string remark = "the text: larger from 0.016 to 0.1 s, smaller at 0.2 s";
  for (const PrintedDesign& printed : table_7_5) {
    add_scheduled_gain(report, setting, printed, remark);
    add_constant_gain(report, setting, printed, remark);
  }
  return report;
}

}  // namespace limpid::examples
