// SPDX-License-Identifier: MIT
#include "prediction/report.hpp"

#include <common/words.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace limpid::bench {

namespace {

using examples::number_or_null;
using Json = nlohmann::ordered_json;

double seconds_of(const Selection& selection, std::size_t period) {
  return static_cast<double>(selection.periods[period]) * tick_seconds;
}

Json windows_of(const Figures& figures) {
  Json list = Json::array();
  for (const Window& window : figures.windows) {
    list.push_back({{"start_s", window.start},
                    {"error_over_hold", number_or_null(window.ratio)},
                    {"hold_error", number_or_null(window.hold_error)},
                    {"judged", window.judged}});
  }
  return list;
}

Json run_of(const Selection& selection, const Row& row) {
  return {{"disturbance", selection.disturbances[row.disturbance].name},
          {"tissue", selection.tissues[row.tissue].name},
          {"force", selection.forces[row.force].name},
          {"period_s", seconds_of(selection, row.period)},
          {"predictor", predictor_name(selection, row.predictor)},
          {"held_out", held_out(selection, row)},
          {"early", number_or_null(row.figures.early)},
          {"late", number_or_null(row.figures.late)},
          {"worst", number_or_null(row.figures.worst)},
          {"windows", windows_of(row.figures)}};
}

Json cell_of(const Selection& selection, const Cell& cell) {
  return {{"held_out", cell.held_out},
          {"disturbance", selection.disturbances[cell.disturbance].name},
          {"tissue", selection.tissues[cell.tissue].name},
          {"period_s", seconds_of(selection, cell.period)},
          {"predictor", predictor_name(selection, cell.predictor)},
          {"early", number_or_null(cell.early)},
          {"late", number_or_null(cell.late)},
          {"worst", number_or_null(cell.worst)},
          {"runs", cell.runs}};
}

Json finding_of(const Finding& finding) {
  return {{"what", finding.what},   {"asked", finding.asked},   {"worst", number_or_null(finding.worst)},
          {"where", finding.where}, {"judged", finding.judged}, {"missed", finding.missed},
          {"met", finding.met()}};
}

}  // namespace

std::string as_csv(const Results& results) {
  const auto& [selection, rows, cells, findings] = results;
  std::ostringstream out;
  out.precision(9);
  out << "disturbance,tissue,force,period_s,predictor,held_out,early,late,worst\n";
  for (const Row& row : rows) {
    out << selection.disturbances[row.disturbance].name << ',' << selection.tissues[row.tissue].name << ",\""
        << selection.forces[row.force].name << "\"," << seconds_of(selection, row.period) << ','
        << predictor_name(selection, row.predictor) << ',' << held_out(selection, row) << ',' << row.figures.early
        << ',' << row.figures.late << ',' << row.figures.worst << '\n';
  }
  return out.str();
}

std::string as_json(const Results& results) {
  const auto& [selection, rows, cells, findings] = results;
  Json runs = Json::array(), means = Json::array(), verdicts = Json::array();
  for (const Row& row : rows) runs.push_back(run_of(selection, row));
  for (const Cell& cell : cells) means.push_back(cell_of(selection, cell));
  for (const Finding& finding : findings) verdicts.push_back(finding_of(finding));
  return Json{{"seconds", selection.seconds},
              {"judged", predictor_name(selection, judged_predictor(selection))},
              {"verdict", verdicts},
              {"means_over_forces", means},
              {"runs", runs}}
             .dump() +
         "\n";
}

}  // namespace limpid::bench
