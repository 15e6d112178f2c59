// SPDX-License-Identifier: MIT
// Sections 7.1 and 7.2: the gains of the experiments and their stability regions.
#include "section.hpp"
#include "stability_regions.hpp"

namespace limpid::examples {

namespace {

// Table 7.1.
PredictorDesign<> experiment() { return {.tool = {.mass = 0.5, .damping = 0.1, .stiffness = 0}}; }

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

}  // namespace

SectionReport section_7_1() {
  SectionReport report{.title = "7.1 experiments with the constant gain: gains and stability regions"};
  const DesignSetting setting{.design = experiment(), .nominal = {600, 20}, .rates = {}, .grid = thesis_grid(1)};
  for (const PrintedDesign& printed : table_7_2) {
    add_constant_gain(report, setting, printed, "the text: quite small, larger as the sampling time increases");
  }
  return report;
}

SectionReport section_7_2() {
  SectionReport report{.title = "7.2 experiments with the gain-scheduled predictor: gains and stability regions"};
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
