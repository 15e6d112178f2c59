// SPDX-License-Identifier: MIT
#include "prediction/matrix.hpp"

#include "prediction/parallel.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace limpid::bench {

namespace {

// Runs that share what truly happens: they differ in how that is sampled.
struct Group {
  std::size_t tissue = 0, force = 0;
  std::vector<std::size_t> disturbances;
};

std::vector<Group> groups_of(const Selection& selection) {
  const auto& all = selection.disturbances;
  std::vector<std::vector<std::size_t>> alike;
  for (std::size_t d = 0; d < all.size(); ++d) {
    const auto same = [&](const auto& group) {
      return all[group.front()].tissue == all[d].tissue && all[group.front()].idle == all[d].idle;
    };
    const auto found = std::ranges::find_if(alike, same);
    if (found == alike.end()) {
      alike.push_back({d});
    } else {
      found->push_back(d);
    }
  }
  std::vector<Group> groups;
  for (std::size_t tissue = 0; tissue < selection.tissues.size(); ++tissue) {
    for (std::size_t force = 0; force < selection.forces.size(); ++force) {
      for (const auto& disturbances : alike) groups.push_back({tissue, force, disturbances});
    }
  }
  return groups;
}

// All predictors over one course, and the floor.
void run_course(const Selection& selection, const Course& course, const Row& of_course, std::vector<Row>& rows) {
  const Disturbance& disturbance = selection.disturbances[of_course.disturbance];
  const double late_from = disturbance.steps() ? course.truth.step_at : late_seconds;
  const Trace hold = contenders().front().run(course);
  for (std::size_t p = 0; p <= selection.predictors.size(); ++p) {
    const Trace trace = p < selection.predictors.size()
                            ? selection.predictors[p].run(course)
                            : floor_trace(course, selection.tissues[of_course.tissue], disturbance.tissue);
    rows.push_back(of_course);
    rows.back().predictor = p;
    rows.back().figures = judge(course.truth, trace, hold, late_from);
  }
}

std::vector<Row> run_group(const Selection& selection, const Group& group) {
  const Tissue& tissue = selection.tissues[group.tissue];
  const Force& force = selection.forces[group.force];
  const Disturbance& first = selection.disturbances[group.disturbances.front()];
  const Truth truth = simulate(tissue, force, first.tissue, selection.seconds, first.idle);
  std::vector<Row> rows;
  for (const std::size_t d : group.disturbances) {
    for (std::size_t p = 0; p < selection.periods.size(); ++p) {
      const Disturbance& disturbance = selection.disturbances[d];
      const std::size_t period = selection.periods[p];
      const std::string of = tissue.name + ' ' + force.name + ' ' + disturbance.name + ' ' + std::to_string(period);
      const auto samples = sampled(truth, period, disturbance.sensing, seed_of(of));
      const Row of_course{.disturbance = d, .tissue = group.tissue, .force = group.force, .period = p, .figures = {}};
      run_course(selection, {truth, samples, period}, of_course, rows);
    }
  }
  return rows;
}

auto place_of(const Row& row) { return std::tie(row.disturbance, row.tissue, row.force, row.period, row.predictor); }

}  // namespace

std::vector<Row> run_matrix(const Selection& selection, unsigned threads) {
  const std::vector<Group> groups = groups_of(selection);
  std::vector<std::vector<Row>> of_groups(groups.size());
  in_parallel(groups.size(), threads, [&](std::size_t i) { of_groups[i] = run_group(selection, groups[i]); });
  std::vector<Row> rows;
  for (auto& of_group : of_groups) std::ranges::move(of_group, std::back_inserter(rows));
  std::ranges::sort(rows, [](const Row& l, const Row& r) { return place_of(l) < place_of(r); });
  return rows;
}

bool held_out(const Selection& selection, const Row& row) {
  return selection.tissues[row.tissue].held_out || selection.forces[row.force].held_out;
}

const std::string& predictor_name(const Selection& selection, std::size_t predictor) {
  static const std::string floor = "floor";
  return predictor < selection.predictors.size() ? selection.predictors[predictor].name : floor;
}

}  // namespace limpid::bench
