// SPDX-License-Identifier: MIT
#include "time_error/row.hpp"

#include <common/gnuplot.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace limpid::bench {

namespace {

using examples::quoted;

const std::vector<std::string> scalars{"float", "double", "long double"};

double height_of(const Row& row) { return std::max(row.error(), 1e-22); }

// All, or the front.
void write_points(std::ostream& out, const std::vector<Row>& rows, bool all) {
  for (const Row& row : rows) {
    if (!std::isfinite(row.error()) || (!all && !row.on_front)) continue;
    out << row.time.ns << ' ' << height_of(row) << " \"" << row.method << (row.is_default ? " (default)" : "")
        << "\"\n";
  }
}

void write_panel(std::ostream& data, std::ostream& plots, const std::vector<Row>& rows, int panel) {
  plots << "set title " << quoted(rows.front().name) << " noenhanced\nplot ";
  for (std::size_t s = 0; s < scalars.size(); ++s) {
    std::vector<Row> of_scalar;
    for (const Row& row : rows) {
      if (row.scalar == scalars[s]) of_scalar.push_back(row);
    }
    const std::string name = "$data_" + std::to_string(panel) + "_" + std::to_string(s), colour = std::to_string(s + 1);
    data << name << " << END_OF_DATA\n";
    write_points(data, of_scalar, true);
    data << "END_OF_DATA\n" << name << "_front << END_OF_DATA\n";
    write_points(data, of_scalar, false);
    data << "END_OF_DATA\n";
    plots << (s > 0 ? ", " : "") << name << " using 1:2 with points pt 7 ps 0.6 lc " << colour << " title "
          << quoted(scalars[s]) << ", " << name << "_front using 1:2 with points pt 6 ps 1.4 lc " << colour
          << " notitle";
    if (scalars[s] == "double") {  // the others stand beside it
      plots << ", " << name << " using 1:2:3 with labels noenhanced left offset 0.9,0.3 font ',9' notitle";
    }
  }
  plots << '\n';
}

std::vector<std::vector<Row>> by_case(const std::vector<Row>& rows, const std::string& place) {
  std::vector<std::vector<Row>> cases;
  for (const Row& row : rows) {
    if (row.place != place) continue;
    if (cases.empty() || cases.back().front().name != row.name) cases.emplace_back();
    cases.back().push_back(row);
  }
  return cases;
}

std::string draw_place(const std::vector<Row>& rows, const std::string& place, const std::string& folder) {
  const auto cases = by_case(rows, place);
  std::string file = place;
  std::replace(file.begin(), file.end(), ' ', '_');
  const std::string path = (std::filesystem::path(folder) / (file + ".svg")).string();
  if (!examples::gnuplot_is_installed()) {
    std::vector<Row> of_place;
    for (const auto& group : cases) of_place.insert(of_place.end(), group.begin(), group.end());
    return examples::write_instead(path, as_csv(of_place));
  }
  std::ostringstream data, plots;
  for (std::size_t i = 0; i < cases.size(); ++i) write_panel(data, plots, cases[i], static_cast<int>(i));
  std::ostringstream script;
  script << examples::svg_terminal(1000, 60 + 420 * static_cast<int>(cases.size()), path) << data.str()
         << "set grid\nset logscale xy\nset format y '10^{%T}'\nset xlabel 'time of a step, ns'\n"
         << "set ylabel 'relative error'\nset offsets graph 0.02, graph 0.25, graph 0.05, graph 0.05\n"
         << "set key outside right top\nset multiplot layout " << cases.size() << ",1 title "
         << quoted(place + "; ringed: no other method of its scalar beats it in both; named: double") << " noenhanced\n"
         << plots.str() << "unset multiplot\n";
  examples::run_gnuplot(script.str(), path);
  return path;
}

}  // namespace

std::vector<std::string> draw_work_precision(const std::vector<Row>& rows, const std::string& folder) {
  std::vector<std::string> files;
  std::string last;
  for (const Row& row : rows) {
    if (row.place == last) continue;
    last = row.place;
    files.push_back(draw_place(rows, row.place, folder));
  }
  return files;
}

}  // namespace limpid::bench
