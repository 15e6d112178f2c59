// SPDX-License-Identifier: MIT
#include "prediction/verdict.hpp"

#include <common/words.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace limpid::bench {

namespace {

using examples::words;

constexpr double floor_margin = 1.15, late_asked_of_kinks = 0.02, window_asked = 1;

class Verdict {
 public:
  Verdict(const Selection& selection, const std::vector<Row>& rows, const std::vector<Cell>& cells, bool of_held_out)
      : selection_{selection},
        rows_{rows},
        cells_{cells},
        predictor_{judged_predictor(selection)},
        of_held_out_{of_held_out} {}

  [[nodiscard]] std::vector<Finding> findings() const {
    std::vector<Finding> all;
    for (std::size_t d = 0; d < selection_.disturbances.size(); ++d) {
      const Disturbance& disturbance = selection_.disturbances[d];
      if (disturbance.name == "clean") {
        add_clean(d, all);
      } else if (disturbance.steps()) {
        all.push_back(over(d, "2 " + disturbance.name + ", after it, over the law known at once", late_over_floor));
      } else {
        all.push_back(late(d, "2 " + disturbance.name + ", after 8 s", disturbance.late_asked, any_tissue));
      }
    }
    all.push_back(windows());
    std::erase_if(all, [](const Finding& finding) { return finding.judged == 0; });
    if (of_held_out_) {
      for (Finding& finding : all) finding.what = "7 held out: " + finding.what;
    }
    return all;
  }

 private:
  using Ratio = double (*)(const Cell& cell, const Cell& floor);
  using Filter = bool (*)(const Tissue&);

  static double early_over_floor(const Cell& cell, const Cell& floor) { return cell.early / floor.early; }
  static double late_over_floor(const Cell& cell, const Cell& floor) { return cell.late / floor.late; }
  static bool any_tissue(const Tissue&) { return true; }

  void add_clean(std::size_t d, std::vector<Finding>& all) const {
    const auto smooth = [](const Tissue& tissue) { return tissue.smooth; };
    const auto kinked = [](const Tissue& tissue) { return !tissue.smooth; };
    all.push_back(late(d, "1 clean, smooth tissues, after 8 s", selection_.disturbances[d].late_asked, smooth));
    all.push_back(late(d, "1 clean, layered tissue and wall, after 8 s", late_asked_of_kinks, kinked));
    all.push_back(over(d, "1 clean, first 4 s, over the floor's", early_over_floor));
  }

  template <typename Work>
  void each_cell(std::size_t d, const Work& work) const {
    for (const Cell& cell : cells_) {
      if (cell.disturbance == d && cell.predictor == predictor_ && cell.held_out == of_held_out_) work(cell);
    }
  }

  [[nodiscard]] std::string place(std::size_t tissue, std::size_t period) const {
    return tissue_and_period(selection_, tissue, period);
  }

  [[nodiscard]] Finding late(std::size_t d, std::string what, double asked, Filter among) const {
    std::vector<Measured> values;
    each_cell(d, [&](const Cell& cell) {
      if (among(selection_.tissues[cell.tissue])) values.push_back({cell.late, place(cell.tissue, cell.period)});
    });
    return finding_of(std::move(what), asked, std::move(values));
  }

  [[nodiscard]] Finding over(std::size_t d, std::string what, Ratio ratio) const {
    std::vector<Measured> values;
    each_cell(d, [&](const Cell& cell) {
      const Cell& floor = beside(cells_, cell, selection_.predictors.size());
      values.push_back({ratio(cell, floor), place(cell.tissue, cell.period)});
    });
    return finding_of(std::move(what), floor_margin, std::move(values));
  }

  [[nodiscard]] Finding windows() const {
    std::vector<Measured> values;
    for (const Row& row : rows_) {
      if (row.predictor != predictor_ || held_out(selection_, row) != of_held_out_) continue;
      values.push_back({row.figures.worst, selection_.disturbances[row.disturbance].name + ", " +
                                               place(row.tissue, row.period) + ", " +
                                               selection_.forces[row.force].name});
    }
    return finding_of("3 worst 4 s window of any run", window_asked, std::move(values));
  }

  const Selection& selection_;
  const std::vector<Row>& rows_;
  const std::vector<Cell>& cells_;
  std::size_t predictor_;
  bool of_held_out_;
};

}  // namespace

Finding finding_of(std::string what, double asked, std::vector<Measured> values) {
  std::erase_if(values, [](const Measured& each) { return std::isnan(each.value); });
  std::ranges::sort(values, std::greater<>{}, &Measured::value);
  Finding finding{.what = std::move(what),
                  .asked = asked,
                  .worst = std::numeric_limits<double>::quiet_NaN(),
                  .where = {},
                  .judged = values.size(),
                  .missed = {}};
  if (!values.empty()) finding.worst = values.front().value;
  if (!values.empty()) finding.where = values.front().where;
  for (const auto& [value, where] : values) {
    if (!(value <= asked)) finding.missed.push_back(where + words(": %.4g", value));
  }
  return finding;
}

std::string tissue_and_period(const Selection& selection, std::size_t tissue, std::size_t period) {
  return words("%s, T_d = %.3g", selection.tissues[tissue].name.c_str(),
               static_cast<double>(selection.periods[period]) * tick_seconds);
}

std::vector<Finding> verdict(const Selection& selection, const std::vector<Row>& rows, const std::vector<Cell>& cells) {
  std::vector<Finding> all = Verdict(selection, rows, cells, false).findings();
  for (Finding& finding : Verdict(selection, rows, cells, true).findings()) all.push_back(std::move(finding));
  return all;
}

}  // namespace limpid::bench
