// SPDX-License-Identifier: MIT
#include "prediction/report.hpp"

#include <common/words.hpp>
#include <nlohmann/json.hpp>

#include <array>
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

struct NamedPress {
  const char* name;
  const Press& press;
};

std::array<NamedPress, 4> presses_of(const DeviceRow& row) {
  return {{{"judged", row.judged}, {"true", row.ideal}, {"hold", row.hold}, {"hold_as_judged", row.hold_as_judged}}};
}

Json press_of(const Press& press) {
  return {{"l2", number_or_null(press.l2)},        {"late_l2", number_or_null(press.late)},
          {"peak", number_or_null(press.peak)},    {"chatter_Nm", number_or_null(press.chatter)},
          {"torque_limited_share", press.limited}, {"moved_at_the_end_rad", number_or_null(press.motion)},
          {"out_of_reach", press.out_of_reach()}};
}

Json device_run_of(const Selection& selection, const DeviceStudy& study, const DeviceRow& row) {
  const DeviceScenario& scenario = study.scenarios[row.scenario];
  Json run{{"scenario", scenario.name},
           {"tissue", selection.tissues[row.tissue].name},
           {"force", scenario.forces[row.force].name},
           {"period_s", seconds_of(selection, row.period)},
           {"held_out", held_out(selection, study, row)}};
  for (const auto& [name, press] : presses_of(row)) run[name] = press_of(press);
  return run;
}

Json device_cell_of(const Selection& selection, const DeviceStudy& study, const DeviceCell& cell) {
  return {{"held_out", cell.held_out},
          {"scenario", study.scenarios[cell.scenario].name},
          {"tissue", selection.tissues[cell.tissue].name},
          {"period_s", seconds_of(selection, cell.period)},
          {"late_over_true", number_or_null(cell.late)},
          {"hold_late_over_true", number_or_null(cell.hold_late)},
          {"l2_over_hold", number_or_null(cell.l2)},
          {"true_l2_over_hold", number_or_null(cell.ideal_l2)},
          {"l2_over_hold_as_judged", number_or_null(cell.l2_as_followed)},
          {"chatter_over_hold", number_or_null(cell.chatter)},
          {"worst_chatter_over_hold", number_or_null(cell.worst_chatter)},
          {"worst_peak_over_hold", number_or_null(cell.peak)},
          {"torque_limited_share", cell.limited},
          {"moved_at_the_end_rad", number_or_null(cell.motion)},
          {"runs", cell.runs}};
}

Json device_of(const Selection& selection, const DeviceStudy& study) {
  Json runs = Json::array(), means = Json::array();
  for (const DeviceRow& row : study.rows) runs.push_back(device_run_of(selection, study, row));
  for (const DeviceCell& cell : study.cells) means.push_back(device_cell_of(selection, study, cell));
  return {{"over_forces", means}, {"runs", runs}};
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

std::string as_device_csv(const Selection& selection, const DeviceStudy& study) {
  std::ostringstream out;
  out.precision(9);
  out << "scenario,tissue,force,period_s,held_out,signal,l2,late_l2,peak,chatter_Nm,torque_limited_share,"
         "moved_at_the_end_rad,out_of_reach\n";
  for (const DeviceRow& row : study.rows) {
    const DeviceScenario& scenario = study.scenarios[row.scenario];
    for (const auto& [name, press] : presses_of(row)) {
      out << '"' << scenario.name << "\"," << selection.tissues[row.tissue].name << ",\""
          << scenario.forces[row.force].name << "\"," << seconds_of(selection, row.period) << ','
          << held_out(selection, study, row) << ',' << name << ',' << press.l2 << ',' << press.late << ',' << press.peak
          << ',' << press.chatter << ',' << press.limited << ',' << press.motion << ',' << press.out_of_reach() << '\n';
    }
  }
  return out.str();
}

std::string as_json(const Results& results, const DeviceStudy& study) {
  const auto& [selection, rows, cells, findings] = results;
  Json runs = Json::array(), means = Json::array(), verdicts = Json::array();
  for (const Row& row : rows) runs.push_back(run_of(selection, row));
  for (const Cell& cell : cells) means.push_back(cell_of(selection, cell));
  for (const Finding& finding : findings) verdicts.push_back(finding_of(finding));
  return Json{{"seconds", selection.seconds}, {"judged", predictor_name(selection, judged_predictor(selection))},
              {"verdict", verdicts},          {"arm", device_of(selection, study)},
              {"means_over_forces", means},   {"runs", runs}}
             .dump() +
         "\n";
}

}  // namespace limpid::bench
