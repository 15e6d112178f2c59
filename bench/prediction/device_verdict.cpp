// SPDX-License-Identifier: MIT
#include "prediction/device_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace limpid::bench {

namespace {

constexpr double late_asked = 1.1, l2_asked = 0.35, motion_asked = 2e-4;  // the last in rad, half an encoder step
constexpr std::size_t l2_period = 100, peak_period = 200;                 // ticks

using Place = std::tuple<bool, std::size_t, std::size_t, std::size_t>;

template <typename Ratio>
double mean_of(const std::vector<const DeviceRow*>& rows, const Ratio& ratio) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const DeviceRow* row : rows) values.push_back(ratio(*row));
  return geometric_mean(values);
}

template <typename Figure>
double sum_of(const std::vector<const DeviceRow*>& rows, const Figure& figure) {
  double sum = 0;
  for (const DeviceRow* row : rows) sum += figure(*row);
  return sum;
}

template <typename Figure>
double largest_of(const std::vector<const DeviceRow*>& rows, const Figure& figure) {
  double largest = std::numeric_limits<double>::quiet_NaN();
  for (const DeviceRow* row : rows) largest = std::fmax(largest, figure(*row));
  return largest;
}

DeviceCell cell_of(const Place& place, const std::vector<const DeviceRow*>& rows) {
  DeviceCell cell;
  std::tie(cell.held_out, cell.scenario, cell.tissue, cell.period) = place;
  cell.late = mean_of(rows, [](const DeviceRow& row) { return row.judged.late / row.ideal.late; });
  cell.hold_late = mean_of(rows, [](const DeviceRow& row) { return row.hold.late / row.ideal.late; });
  cell.l2 = mean_of(rows, [](const DeviceRow& row) { return row.judged.l2 / row.hold.l2; });
  cell.ideal_l2 = mean_of(rows, [](const DeviceRow& row) { return row.ideal.l2 / row.hold.l2; });
  cell.l2_as_followed = mean_of(rows, [](const DeviceRow& row) { return row.judged.l2 / row.hold_as_judged.l2; });
  cell.chatter = sum_of(rows, [](const DeviceRow& row) { return row.judged.chatter; }) /
                 sum_of(rows, [](const DeviceRow& row) { return row.hold.chatter; });
  cell.worst_chatter = largest_of(rows, [](const DeviceRow& row) { return row.judged.chatter / row.hold.chatter; });
  cell.peak = largest_of(rows, [](const DeviceRow& row) { return row.judged.peak / row.hold.peak; });
  cell.motion = largest_of(rows, [](const DeviceRow& row) { return row.judged.motion; });
  cell.limited =
      sum_of(rows, [](const DeviceRow& row) { return row.judged.limited; }) / static_cast<double>(rows.size());
  cell.runs = rows.size();
  return cell;
}

std::vector<DeviceCell> cells_of(const Selection& selection, const DeviceStudy& study) {
  std::map<Place, std::vector<const DeviceRow*>> places;
  for (const DeviceRow& row : study.rows) {
    if (row.out_of_reach()) continue;
    places[{held_out(selection, study, row), row.scenario, row.tissue, row.period}].push_back(&row);
  }
  std::vector<DeviceCell> cells;
  cells.reserve(places.size());
  for (const auto& [place, rows] : places) cells.push_back(cell_of(place, rows));
  return cells;
}

class DeviceVerdict {
 public:
  DeviceVerdict(const Selection& selection, const DeviceStudy& study, bool of_held_out)
      : selection_{selection}, study_{study}, of_held_out_{of_held_out} {}

  [[nodiscard]] std::vector<Finding> findings() const {
    std::vector<Finding> all;
    for (std::size_t s = 0; s < study_.scenarios.size(); ++s) add(s, all);
    std::erase_if(all, [](const Finding& finding) { return finding.judged == 0; });
    if (of_held_out_) {
      for (Finding& finding : all) finding.what = "7 held out: " + finding.what;
    }
    return all;
  }

 private:
  void add(std::size_t s, std::vector<Finding>& all) const {
    const DeviceScenario& scenario = study_.scenarios[s];
    const auto of_period = [&](std::size_t ticks) {
      return [&, ticks](const DeviceCell& cell) { return selection_.periods[cell.period] == ticks; };
    };
    const auto smooth = [&](const DeviceCell& cell) { return selection_.tissues[cell.tissue].smooth; };
    const auto kinked = [&](const DeviceCell& cell) { return !smooth(cell); };
    if (!scenario.realistic()) {
      const std::string what = "4 " + scenario.name + ", after 8 s, total error over the true signal's, ";
      all.push_back(cells(s, what + "smooth tissues", late_asked, &DeviceCell::late, smooth));
      all.push_back(cells(s, what + "layered tissue and wall", late_asked, &DeviceCell::late, kinked));
      return;
    }
    const std::string what = "5 " + scenario.name + ", ", early = what + "T_d = .1, ", slow = what + "T_d = .2, ";
    if (scenario.ends_at_rest) {
      const auto any = [](const DeviceCell&) { return true; };
      all.push_back(cells(s, what + "rad moved in the last 4 s", motion_asked, &DeviceCell::motion, any));
      return;
    }
    all.push_back(cells(s, early + "total error over hold's", l2_asked, &DeviceCell::l2, of_period(l2_period)));
    all.push_back(cells(s, early + "chatter over hold's", 1, &DeviceCell::chatter, of_period(l2_period)));
    all.push_back(cells(s, slow + "peak over hold's", 1, &DeviceCell::peak, of_period(peak_period)));
  }

  template <typename Among>
  [[nodiscard]] Finding cells(std::size_t scenario, std::string what, double asked, double DeviceCell::*figure,
                              const Among& among) const {
    std::vector<Measured> values;
    for (const DeviceCell& cell : study_.cells) {
      if (cell.scenario != scenario || cell.held_out != of_held_out_ || !among(cell)) continue;
      values.push_back({cell.*figure, tissue_and_period(selection_, cell.tissue, cell.period)});
    }
    return finding_of(std::move(what), asked, std::move(values));
  }

  const Selection& selection_;
  const DeviceStudy& study_;
  bool of_held_out_;
};

}  // namespace

DeviceStudy study_device(const Selection& selection, unsigned threads) {
  DeviceStudy study{.scenarios = device_scenarios(selection), .rows = {}, .cells = {}};
  study.rows = run_device(selection, study.scenarios, threads);
  study.cells = cells_of(selection, study);
  return study;
}

bool held_out(const Selection& selection, const DeviceStudy& study, const DeviceRow& row) {
  return selection.tissues[row.tissue].held_out || study.scenarios[row.scenario].forces[row.force].held_out;
}

std::vector<Finding> device_verdict(const Selection& selection, const DeviceStudy& study) {
  std::vector<Finding> all = DeviceVerdict(selection, study, false).findings();
  for (Finding& finding : DeviceVerdict(selection, study, true).findings()) all.push_back(std::move(finding));
  return all;
}

}  // namespace limpid::bench
