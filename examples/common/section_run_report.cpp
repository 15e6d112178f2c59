// SPDX-License-Identifier: MIT
#include "section_run_report.hpp"

#include "words.hpp"

#include <optional>
#include <ostream>
#include <string>

namespace limpid::examples {

namespace {

using Json = nlohmann::ordered_json;

// Total error with prediction against without, (3.36) to (3.38).
PrintedChange change(const RunErrors& with, const RunErrors& without) {
  return {with.total.max - without.total.max, relative_change(with.total.max, without.total.max),
          relative_change(with.total.l2, without.total.l2)};
}

std::string described(const PrintedChange& change) {
  std::string text = change.bound_difference ? words("%+9.2g ", *change.bound_difference) : std::string(10, ' ');
  return text + words("%+8.2f %% %+8.2f %%", 100 * change.bound_change, 100 * change.l2_change);
}

// Of the total error without prediction, which the tables do not print: it shows how hard their force pressed.
std::optional<double> bound_without_prediction(const PrintedChange& printed) {
  if (!printed.bound_difference) return {};
  return *printed.bound_difference / printed.bound_change;
}

constexpr int before_changes = 68;  // columns

std::string printed(const PrintedChange& change) {
  const auto hold = bound_without_prediction(change);
  const std::string label = hold ? words("printed; by it hold's total max is %.2g", *hold) : std::string("printed");
  return words("%*s  ", before_changes, label.c_str()) + described(change);
}

void print(std::ostream& out, const RunComparison& row) {
  for (const RunErrors& run : row.runs) {
    const bool first = &run == &row.runs.front();
    out << words("%-5s %-6s %-14s %9.3g %9.3g %9.3g %9.3g", first ? row.name.c_str() : "",
                 first ? words("%g", row.period).c_str() : "", run.predictor.c_str(), run.prediction.max,
                 run.prediction.l2, run.total.max, run.total.l2);
    if (!first) out << "  " << described(change(run, row.runs.front()));
    if (run.status != Status::ok) out << "  # " << describe(run.status);
    out << '\n';
  }
  if (row.printed) out << printed(*row.printed) << '\n';
  if (row.runs.size() < 3) return;
  const PrintedChange schedule = change(row.runs[2], row.runs[1]);
  out << words("%*s", before_changes, "scheduled over constant gain") << "  " << described(schedule);
  if (row.printed) out << "  printed: " << row.printed->over_constant_gain;
  out << '\n';
}

Json as_json(const PrintedChange& change) {
  Json json{{"bound_difference", nullptr}, {"bound_change", change.bound_change}, {"l2_change", change.l2_change}};
  if (change.bound_difference) json["bound_difference"] = *change.bound_difference;
  if (!change.over_constant_gain.empty()) json["over_constant_gain"] = change.over_constant_gain;
  return json;
}

Json as_json(const RunErrors& run) {
  return {{"predictor", run.predictor},
          {"prediction_error", {{"max", run.prediction.max}, {"l2", run.prediction.l2}}},
          {"total_error", {{"max", run.total.max}, {"l2", run.total.l2}}},
          {"status", describe(run.status)},
          {"fault", has(run.status, Status::fault)}};
}

}  // namespace

void print_runs(std::ostream& out, const std::vector<RunComparison>& runs) {
  if (runs.empty()) return;
  out << words("%-5s %-6s %-14s %19s %19s  %s\n", "case", "T_d", "tracked", "prediction max, L2", "total max, L2",
               "total against hold: bound, of it, L2");
  for (const RunComparison& row : runs) print(out, row);
}

Json runs_as_json(const std::vector<RunComparison>& runs) {
  Json rows = Json::array();
  for (const RunComparison& row : runs) {
    Json entry{{"case", row.name}, {"sample_period", row.period}, {"runs", Json::array()}, {"printed", nullptr}};
    for (const RunErrors& run : row.runs) {
      Json errors = as_json(run);
      if (&run != &row.runs.front()) errors["change"] = as_json(change(run, row.runs.front()));
      entry["runs"].push_back(errors);
    }
    if (row.printed) entry["printed"] = as_json(*row.printed);
    if (row.printed && bound_without_prediction(*row.printed)) {
      entry["printed"]["hold_bound"] = *bound_without_prediction(*row.printed);
    }
    rows.push_back(entry);
  }
  return rows;
}

}  // namespace limpid::examples
