// SPDX-License-Identifier: MIT
#include "prediction/report.hpp"

#include <cstdio>
#include <set>

namespace limpid::bench {

namespace {

double seconds_of(const Selection& selection, std::size_t period) {
  return static_cast<double>(selection.periods[period]) * tick_seconds;
}

void print_cell(const Selection& selection, const DeviceScenario& scenario, const DeviceCell& cell) {
  std::printf("  %-12s T_d = %-6.3g", selection.tissues[cell.tissue].name.c_str(), seconds_of(selection, cell.period));
  if (!scenario.realistic()) {
    std::printf("after 8 s over the true signal's %.3f, hold's %.2f", cell.late, cell.hold_late);
  } else if (scenario.ends_at_rest) {
    std::printf("moved in the last 4 s %.2g rad", cell.motion);
  } else {
    std::printf(
        "over hold's %.3f, the true signal's %.3f, over hold's followed likewise %.3f; chatter %.2f (%.2f), "
        "peak %.2f; ",
        cell.l2, cell.ideal_l2, cell.l2_as_followed, cell.chatter, cell.worst_chatter, cell.peak);
    std::printf("torque limited in %.3f", cell.limited);
  }
  std::printf(" (%zu runs)\n", cell.runs);
}

// Of all periods in one line.
void print_left_out(const Selection& selection, const DeviceStudy& study, std::size_t scenario) {
  std::set<std::string> left_out;
  for (const DeviceRow& row : study.rows) {
    if (row.scenario != scenario || !row.out_of_reach()) continue;
    left_out.insert(selection.tissues[row.tissue].name + ' ' + study.scenarios[scenario].forces[row.force].name);
  }
  for (const std::string& each : left_out) {
    std::printf("  left out at some T_d or all: %s leads hold or the true signal out of the arm's reach\n",
                each.c_str());
  }
}

}  // namespace

void print_device(const Selection& selection, const DeviceStudy& study) {
  std::printf(
      "\ntotal errors, of the tip from the true tool, %s; peak, and chatter in brackets: the largest of a run\n",
      predictor_name(selection, judged_predictor(selection)).c_str());
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
    for (const bool of_held_out : {false, true}) {
      bool any = false;
      for (const DeviceCell& cell : study.cells) {
        if (cell.scenario != s || cell.held_out != of_held_out) continue;
        if (!any) std::printf("%s%s\n", of_held_out ? "held out, " : "", study.scenarios[s].name.c_str());
        any = true;
        print_cell(selection, study.scenarios[s], cell);
      }
    }
    print_left_out(selection, study, s);
  }
}

}  // namespace limpid::bench
