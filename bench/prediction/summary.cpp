// SPDX-License-Identifier: MIT
#include "prediction/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>

namespace limpid::bench {

namespace {

using Place = std::tuple<bool, std::size_t, std::size_t, std::size_t, std::size_t>;

Cell cell_of(const Place& place, const std::vector<const Row*>& rows) {
  std::vector<double> early, late;
  Cell cell;
  std::tie(cell.held_out, cell.disturbance, cell.tissue, cell.period, cell.predictor) = place;
  cell.worst = std::numeric_limits<double>::quiet_NaN();
  for (const Row* row : rows) {
    early.push_back(row->figures.early);
    late.push_back(row->figures.late);
    cell.worst = std::fmax(cell.worst, row->figures.worst);
  }
  cell.early = geometric_mean(early);
  cell.late = geometric_mean(late);
  cell.runs = rows.size();
  return cell;
}

}  // namespace

std::vector<Cell> cells_of(const Selection& selection, const std::vector<Row>& rows) {
  std::map<Place, std::vector<const Row*>> places;
  for (const Row& row : rows) {
    places[{held_out(selection, row), row.disturbance, row.tissue, row.period, row.predictor}].push_back(&row);
  }
  std::vector<Cell> cells;
  cells.reserve(places.size());
  for (const auto& [place, of_place] : places) cells.push_back(cell_of(place, of_place));
  return cells;
}

const Cell& beside(const std::vector<Cell>& cells, const Cell& cell, std::size_t predictor) {
  const auto place = [](const Cell& c) { return std::tie(c.held_out, c.disturbance, c.tissue, c.period, c.predictor); };
  Cell sought = cell;
  sought.predictor = predictor;
  const auto found =
      std::ranges::lower_bound(cells, sought, [&](const Cell& l, const Cell& r) { return place(l) < place(r); });
  if (found == cells.end() || place(*found) != place(sought)) throw std::logic_error("no such cell");
  return *found;
}

std::size_t judged_predictor(const Selection& selection) {
  for (const char* name : {"chosen", "curve"}) {
    const auto found = std::ranges::find(selection.predictors, name, &Contender::name);
    if (found != selection.predictors.end()) return static_cast<std::size_t>(found - selection.predictors.begin());
  }
  return selection.predictors.size() - 1;
}

}  // namespace limpid::bench
