// SPDX-License-Identifier: MIT
#include "design_cell.hpp"
#include "design_report.hpp"
#include "design_words.hpp"

#include <limpid/design/map.hpp>

#include <algorithm>

namespace limpid::examples {

namespace {

using Json = nlohmann::ordered_json;
using Cells = GridMap<CellAnswer>;

// The count of a map, as a line of the table and as a number of the JSON.
struct Count {
  const char* field;
  const char* what;
  bool (*holds)(const CellAnswer&);
};

constexpr Count counts[] = {
    {"feasible", "feasible", [](const CellAnswer& cell) { return cell.verdict == Verdict::feasible; }},
    {"infeasible", "infeasible", [](const CellAnswer& cell) { return cell.verdict == Verdict::infeasible; }},
    {"undecided", "undecided", [](const CellAnswer& cell) { return cell.verdict == Verdict::undecided; }},
    {"certified", "certified", [](const CellAnswer& cell) { return cell.certified; }},
    {"sampled_stable", "sampled predictor stable", [](const CellAnswer& cell) { return cell.radius < 1; }},
    {"delay_stable", "delay system stable", [](const CellAnswer& cell) { return cell.root.real() < 0; }}};

Json as_json(const limpid::Tissue<>& tissue, const CellAnswer& cell) {
  Json json{{"stiffness", tissue.stiffness},
            {"damping", tissue.damping},
            {"feasible", cell.verdict == Verdict::feasible},
            {"verdict", limpid::describe(cell.verdict)},
            {"certified", cell.certified},
            {"sampled_radius", number_or_null(cell.radius)},
            {"delay_root", number_or_null(cell.root.real())},
            {"delay_root_imaginary", number_or_null(std::abs(cell.root.imag()))}};
  if (!cell.reason.empty()) json["reason"] = cell.reason;
  return json;
}

// "k_e = 200 N/m: b_e = 23 to 40 N s/m" for each row that has such cells; at most ten rows.
std::string list_cells(const Cells& map, bool (*holds)(const CellAnswer&)) {
  std::string text;
  int rows = 0;
  for (std::size_t row = 0; row < map.grid.rows(); ++row) {
    std::string spans;
    for (std::size_t begin = 0, end = 0; begin < map.grid.columns(); begin = std::max(end, begin + 1)) {
      if (!holds(map.at(row, begin))) continue;
      for (end = begin + 1; end < map.grid.columns() && holds(map.at(row, end));) ++end;
      spans += words(spans.empty() ? "%.6g" : ", %.6g", map.grid.damping[begin]);
      if (end > begin + 1) spans += words(" to %.6g", map.grid.damping[end - 1]);
    }
    if (spans.empty()) continue;
    if (++rows > 10) return text + "  and further rows\n";
    text += words("  k_e = %.6g N/m: b_e = ", map.grid.stiffness[row]) + spans + " N s/m\n";
  }
  return text;
}

HeatPanel panel(const Cells& map, const std::string& title, const ColourScale& scale,
                double (*value)(const CellAnswer&)) {
  HeatPanel result{title, "k_e (N/m)", "b_e (N s/m)", {}, {}, {}, scale};
  for (std::size_t i = 0; i < map.grid.rows(); ++i) result.x.push_back(map.grid.stiffness[i]);
  for (std::size_t j = 0; j < map.grid.columns(); ++j) result.y.push_back(map.grid.damping[j]);
  for (const CellAnswer& cell : map.cells) result.values.push_back(value(cell));
  return result;
}

double region(Verdict verdict) { return verdict == Verdict::feasible ? 1 : verdict == Verdict::infeasible ? 0 : 0.5; }

HeatMap plot_of(const DesignTask& task, const std::string& title, const Cells& map) {
  HeatMap plot{title, {}, 2};
  if (is_inequality(task.theorem)) {
    plot.panels.push_back(panel(map, std::string("Theorem ") + name(task.theorem) + " feasible", region_scale,
                                [](const CellAnswer& cell) { return region(cell.verdict); }));
  }
  if (!task.gain) return plot;
  const auto radius = [](const CellAnswer& cell) { return cell.radius; };
  const auto root = [](const CellAnswer& cell) { return cell.root.real(); };
  double least = 0, most = 0;
  for (const CellAnswer& cell : map.cells) {
    least = std::min(least, cell.root.real());
    most = std::max(most, cell.root.real());
  }
  plot.panels.push_back(panel(map, "sampled predictor stable", region_scale,
                              [](const CellAnswer& cell) { return cell.radius < 1 ? 1.0 : 0.0; }));
  plot.panels.push_back(panel(map, "spectral radius", {"radius", 0, 1.2}, radius));
  if (least < most) plot.panels.push_back(panel(map, "rightmost root of the delay system", {"1/s", least, most}, root));
  return plot;
}

}  // namespace

DesignReport map_gain(const DesignTask& task, const std::function<void(double)>& progress, HeatMap* plot) {
  const CellTest test(task);
  const Cells map = limpid::map<CellAnswer>(task.grid, test, {.threads = task.threads, .progress = progress});
  DesignReport report{.gain = task.gain};
  const std::string gain = task.gain ? describe(*task.gain, task.scheduled) : std::string("any gain");
  const std::string title = gain + words(", T_d = %.6g s", task.design.T_d);
  report.words = words("Theorem %s, ", name(task.theorem)) + title + words(", %zu cells\n", map.cells.size());
  if (!is_inequality(task.theorem)) report.words = title + words(", %zu cells\n", map.cells.size());
  report.json["cells"] = map.cells.size();
  for (const Count& count : counts) {
    const bool of_gain = count.field == std::string("sampled_stable") || count.field == std::string("delay_stable");
    const std::size_t number = map.count(count.holds);
    report.json[count.field] = of_gain && !task.gain ? Json(nullptr) : Json(number);
    if (of_gain ? task.gain.has_value() : is_inequality(task.theorem)) {
      report.words += row(count.what, std::to_string(number));
    }
  }
  for (const Count& count : {counts[1], counts[2]}) {
    if (is_inequality(task.theorem) && map.count(count.holds) > 0) {
      report.words += std::string(count.what) + " cells:\n" + list_cells(map, count.holds);
    }
  }
  report.json["list"] = Json::array();
  for (std::size_t i = 0; i < map.cells.size(); ++i) report.json["list"].push_back(as_json(task.grid[i], map.cells[i]));
  if (task.gain) report.json["gain"] = numbers_of(*task.gain, task.scheduled);
  report.json["settings"] = settings_of(task);
  if (plot != nullptr) *plot = plot_of(task, title, map);
  return report;
}

}  // namespace limpid::examples
