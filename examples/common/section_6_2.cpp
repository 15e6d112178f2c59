// SPDX-License-Identifier: MIT
// Sections 6.2.1 and 6.2.2: the gain-scheduled predictor's gains and stability regions.
#include "section.hpp"
#include "stability_regions.hpp"

namespace limpid::examples {

namespace {

// k_t = 0: the worst case of 6.2.1, kept in 6.2.2.
DesignSetting setting() {
  return {.design = {.tool = {.mass = 0.1, .damping = 0.1, .stiffness = 0}},
          .nominal = {1100, 30},
          .rates = {1.8e5, 2000},
          .grid = thesis_grid(20)};
}

// Table 6.6. Its L0 at 0.1 s, -2.5e-7, is -2.5e-8 in the text of 6.2.1: neither is of weight.
const std::vector<PrintedDesign> table_6_6{
    {0.016, {-440.8, -12.1}, {{-2.2e-3, -5.9e-5}, {-3.5e-2, -1.0e-3}, {-2.7e-2, -8.7e-4}}, "6.36", "6.35"},
    {0.032, {-202.6, -5.13}, {{6.7e-5, 2.1e-6}, {-2.8e-3, 6.0e-4}, {9.8e-4, 2.2e-5}}, "6.38", "6.37"},
    {0.100, {-194.8, -4.89}, {{-7.3e-5, -2.5e-7}, {-2.6e-3, 3.0e-4}, {-9.3e-4, -2.9e-5}}, "6.40", "6.39"}};

}  // namespace

SectionReport section_6_2_1() {
  SectionReport report{.title = "6.2.1 gain-scheduled predictor, linear environment: gains and stability regions"};
  PrintedDesign printed = table_6_6.back();
  printed.scheduled = {{-7.31e-5, -2.5e-8}, {-2.61e-3, 2.75e-4}, {-9.27e-4, -2.89e-5}};
  printed.constant_figure = "6.31";
  printed.scheduled_figure = "6.30";
  add_scheduled_gain(report, setting(), printed,
                     "the text: much smaller than the constant gain's, a narrow band at two extremes of the rates");
  add_constant_gain(report, setting(), printed, "the text: stable where there is a solution for each parameter set");
  return report;
}

SectionReport section_6_2_2() {
  SectionReport report{.title = "6.2.2 gain-scheduled predictor, nonlinear environment: gains and stability regions"};
  for (const PrintedDesign& printed : table_6_6) {
    add_scheduled_gain(report, setting(), printed, "the text: larger than the constant gain's, not the whole range");
    add_constant_gain(report, setting(), printed, "the text: smaller than the gain-scheduled predictor's");
  }
  return report;
}

}  // namespace limpid::examples
