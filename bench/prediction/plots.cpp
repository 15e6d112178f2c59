// SPDX-License-Identifier: MIT
#include "prediction/report.hpp"

#include <common/chart.hpp>
#include <common/words.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <utility>

namespace limpid::bench {

namespace {

using examples::Chart;
using examples::Curve;
using examples::Panel;
using examples::words;

constexpr std::size_t worst_drawn = 6;
constexpr double least_drawn = 1e-7;

double seconds_of(const Selection& selection, std::size_t period) {
  return static_cast<double>(selection.periods[period]) * tick_seconds;
}

std::string file(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / (name + ".svg")).string();
}

// A line for each tissue, solid, and its floor, dashed in the same colour and without a name.
Panel late_panel(const Results& results, bool of_held_out, std::size_t disturbance) {
  const auto& [selection, rows, cells, findings] = results;
  const std::size_t judged = judged_predictor(selection);
  Panel panel{.title = of_held_out ? "held out" : "",
              .x_label = "T_d (s)",
              .y_label = "late error over hold's",
              .curves = {},
              .logarithmic = true,
              .logarithmic_x = true};
  for (const std::size_t predictor : {judged, selection.predictors.size()}) {
    for (std::size_t tissue = 0; tissue < selection.tissues.size(); ++tissue) {
      const bool is_floor = predictor != judged;
      Curve curve{.name = is_floor ? "" : selection.tissues[tissue].name,
                  .x = {},
                  .y = {},
                  .dashed = is_floor,
                  .colour = static_cast<int>(tissue) + 1};
      for (const Cell& cell : cells) {
        if (cell.held_out != of_held_out || cell.disturbance != disturbance || cell.tissue != tissue ||
            cell.predictor != predictor || !std::isfinite(cell.late)) {
          continue;
        }
        curve.x.push_back(seconds_of(selection, cell.period));
        curve.y.push_back(std::max(cell.late, least_drawn));
      }
      if (!curve.x.empty()) panel.curves.push_back(std::move(curve));
    }
  }
  return panel;
}

std::string draw_disturbance(const Results& results, std::size_t disturbance, const std::string& folder) {
  const Selection& selection = results.selection;
  const std::string& name = selection.disturbances[disturbance].name;
  Chart chart{.title = name + ": " + predictor_name(selection, judged_predictor(selection)), .panels = {}};
  for (const bool of_held_out : {false, true}) {
    Panel panel = late_panel(results, of_held_out, disturbance);
    if (!panel.curves.empty()) chart.panels.push_back(std::move(panel));
  }
  return examples::draw(chart, file(folder, "late_" + name));
}

std::vector<std::size_t> worst_rows(const Results& results) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    const Row& row = results.rows[i];
    if (row.predictor == judged_predictor(results.selection) && std::isfinite(row.figures.worst)) found.push_back(i);
  }
  const auto worst = [&](std::size_t i) { return results.rows[i].figures.worst; };
  std::ranges::stable_sort(found, std::greater<>{}, worst);
  found.resize(std::min(found.size(), worst_drawn));
  return found;
}

Curve window_curve(std::string name, const Row& row) {
  Curve curve{.name = std::move(name), .x = {}, .y = {}};
  for (const Window& window : row.figures.windows) {
    if (!window.judged) continue;
    curve.x.push_back(window.start + window_seconds / 2);
    curve.y.push_back(std::max(window.ratio, least_drawn));
  }
  return curve;
}

std::string draw_worst_windows(const Results& results, const std::string& folder) {
  const auto& [selection, rows, cells, findings] = results;
  const std::string& judged = predictor_name(selection, judged_predictor(selection));
  Chart chart{.title = "windows of 4 s: the worst runs of " + judged, .panels = {}};
  for (const std::size_t i : worst_rows(results)) {
    const Row& row = rows[i];
    const Row& floor = rows[i + selection.predictors.size() - row.predictor];  // of a run's rows the last
    chart.panels.push_back(
        {.title = words("%s, %s, %s, T_d = %.3g s", selection.disturbances[row.disturbance].name.c_str(),
                        selection.tissues[row.tissue].name.c_str(), selection.forces[row.force].name.c_str(),
                        seconds_of(selection, row.period)),
         .x_label = "middle of the window (s)",
         .y_label = "error over hold's",
         .curves = {window_curve(judged, row), window_curve("floor", floor)},
         .logarithmic = true});
  }
  return examples::draw(chart, file(folder, "worst_windows"));
}

}  // namespace

std::vector<std::string> draw_matrix(const Results& results, const std::string& folder) {
  std::filesystem::create_directories(folder);
  std::vector<std::string> files;
  for (std::size_t d = 0; d < results.selection.disturbances.size(); ++d) {
    files.push_back(draw_disturbance(results, d, folder));
  }
  files.push_back(draw_worst_windows(results, folder));
  return files;
}

}  // namespace limpid::bench
