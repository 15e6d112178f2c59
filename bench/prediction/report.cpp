// SPDX-License-Identifier: MIT
#include "prediction/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace limpid::bench {

namespace {

constexpr std::size_t listed = 6;

void print_heading(const Selection& selection, const std::string& of) {
  std::printf("\n%s: first %.0f s (floor) / late / worst window\n%-12s %-14s", of.c_str(), window_seconds, "tissue",
              "predictor");
  for (const std::size_t period : selection.periods) {
    std::printf(" | T_d = %-25.3g", static_cast<double>(period) * tick_seconds);
  }
  std::printf("\n");
}

void print_row(const Results& results, const Cell& first) {
  const auto& [selection, rows, cells, findings] = results;
  std::printf("%-12s %-14s", selection.tissues[first.tissue].name.c_str(),
              predictor_name(selection, first.predictor).c_str());
  for (std::size_t period = 0; period < selection.periods.size(); ++period) {
    Cell sought = first;
    sought.period = period;
    const Cell& cell = beside(cells, sought, first.predictor);
    const Cell& floor = beside(cells, sought, selection.predictors.size());
    std::printf(" | %6.3f (%.3f) %8.5f %6.2f", cell.early, floor.early, cell.late, cell.worst);
  }
  std::printf("\n");
}

void print_table(const Results& results, bool of_held_out, std::size_t disturbance) {
  const auto& [selection, rows, cells, findings] = results;
  bool any = false;
  for (const Cell& cell : cells) {
    if (cell.held_out != of_held_out || cell.disturbance != disturbance || cell.period != 0) continue;
    if (!any) print_heading(selection, (of_held_out ? "held out, " : "") + selection.disturbances[disturbance].name);
    any = true;
    print_row(results, cell);
  }
}

}  // namespace

void print_tables(const Results& results) {
  std::printf("errors of (x, v) in L2 over hold's; means over forces are geometric; late: after %.0f s, or a step\n",
              late_seconds);
  for (const bool of_held_out : {false, true}) {
    for (std::size_t d = 0; d < results.selection.disturbances.size(); ++d) print_table(results, of_held_out, d);
  }
}

void print_unjudged_windows(const Results& results) {
  const auto& [selection, rows, cells, findings] = results;
  std::size_t count = 0;
  for (const Row& row : rows) {
    if (row.predictor != judged_predictor(selection)) continue;
    for (const Window& window : row.figures.windows) {
      if (window.judged) continue;
      if (count++ == 0) std::printf("\nwindows not judged, since hold's own error is under 1 %% of its run's mean\n");
      std::printf("  %s, %s, %s, T_d = %.3g, from %.0f s: %.3g of hold's %.2g\n",
                  selection.disturbances[row.disturbance].name.c_str(), selection.tissues[row.tissue].name.c_str(),
                  selection.forces[row.force].name.c_str(),
                  static_cast<double>(selection.periods[row.period]) * tick_seconds, window.start, window.ratio,
                  window.hold_error);
    }
  }
}

void print_verdict(const Results& results) {
  const auto& [selection, rows, cells, findings] = results;
  std::printf("\nasked of %s\n", predictor_name(selection, judged_predictor(selection)).c_str());
  for (const Finding& finding : findings) {
    std::printf("%s: %.4g (%s), asked at most %.4g; ", finding.what.c_str(), finding.worst, finding.where.c_str(),
                finding.asked);
    if (finding.met()) {
      std::printf("met\n");
      continue;
    }
    std::printf("missed in %zu of %zu\n", finding.missed.size(), finding.judged);
    for (std::size_t i = 0; i < std::min(finding.missed.size(), listed); ++i) {
      std::printf("    %s\n", finding.missed[i].c_str());
    }
  }
}

}  // namespace limpid::bench
