// SPDX-License-Identifier: MIT
#include "heat_map.hpp"

#include "gnuplot.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace limpid::examples {

namespace {

// The thesis's colours of a stability region.
constexpr const char* region_colours =
    "set palette maxcolors 3 defined (0 '#2b4ea2', 0.333 '#2b4ea2', 0.333 '#9a9a9a', 0.667 '#9a9a9a', "
    "0.667 '#f7e11b', 1 '#f7e11b')\nset cbtics ('no' 0.167, 'undecided' 0.5, 'yes' 0.833)\n";

// From dark to yellow, even in lightness.
constexpr const char* value_colours =
    "set palette maxcolors 0 defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 '#fde725')\n";

double step_of(const std::vector<double>& side) { return side.size() > 1 ? side[1] - side[0] : 1; }

// As drawn: one of 128 colours, so that equal neighbours can be drawn as one box.
double colour_of(double value, const ColourScale& scale) {
  const double part = (std::clamp(value, scale.least, scale.most) - scale.least) / (scale.most - scale.least);
  return scale.least + (scale.most - scale.least) * std::round(128 * part) / 128;
}

// Centre, half width, half height and value of each run of equal colours along y.
void write_column(std::ostream& out, const HeatPanel& panel, std::size_t i) {
  const auto colour = [&](std::size_t j) { return colour_of(panel.values[i * panel.y.size() + j], panel.scale); };
  const double half = step_of(panel.y) / 2;
  for (std::size_t begin = 0, end = 0; begin < panel.y.size(); begin = end) {
    const double here = colour(begin);
    for (end = begin + 1; end < panel.y.size() && colour(end) == here;) ++end;
    if (std::isnan(here)) continue;
    const double bottom = panel.y[begin] - half, top = panel.y[end - 1] + half;
    out << panel.x[i] << ' ' << (bottom + top) / 2 << ' ' << step_of(panel.x) / 2 << ' ' << (top - bottom) / 2 << ' '
        << here << '\n';
  }
}

void write_data(std::ostream& out, const HeatMap& map) {
  for (std::size_t p = 0; p < map.panels.size(); ++p) {
    out << "$data_" << p << " << END_OF_MAP\n";
    for (std::size_t i = 0; i < map.panels[p].x.size(); ++i) write_column(out, map.panels[p], i);
    out << "END_OF_MAP\n";
  }
}

void write_range(std::ostream& out, const char* axis, const std::vector<double>& side) {
  const double half = step_of(side) / 2;
  out << "set " << axis << "range [" << side.front() - half << ':' << side.back() + half << "]\n";
}

void write_panel(std::ostream& out, const HeatPanel& panel, std::size_t index) {
  write_range(out, "x", panel.x);
  write_range(out, "y", panel.y);
  out << "unset cbtics\nset cbtics autofreq\n"
      << (panel.scale.regions ? region_colours : value_colours) << "set cbrange [" << panel.scale.least << ':'
      << panel.scale.most << "]\nset cblabel " << quoted(panel.scale.label) << " noenhanced\n";
  out << "set title " << quoted(panel.title) << " noenhanced\nset xlabel " << quoted(panel.x_label)
      << " noenhanced\nset ylabel " << quoted(panel.y_label) << " noenhanced\nplot $data_" << index
      << " using 1:2:3:4:5 with boxxyerror fillstyle solid noborder lc palette notitle\n";
}

std::string script(const HeatMap& map, const std::string& svg_path) {
  const int panels = static_cast<int>(map.panels.size()), columns = std::clamp(map.columns, 1, std::max(panels, 1));
  const int rows = (panels + columns - 1) / columns;
  std::ostringstream out;
  out.precision(10);
  out << svg_terminal(40 + 500 * columns, 60 + 330 * rows, svg_path);
  write_data(out, map);
  out << "set tics out nomirror\nset tics font ',10'\nset rmargin 13\n"
      << "set multiplot layout " << rows << ',' << columns << " title " << quoted(map.title) << " noenhanced\n";
  for (std::size_t p = 0; p < map.panels.size(); ++p) write_panel(out, map.panels[p], p);
  out << "unset multiplot\n";
  return out.str();
}

std::string as_csv(const HeatMap& map) {
  std::ostringstream out;
  out.precision(10);
  out << "panel,x,y,value\n";
  for (const HeatPanel& panel : map.panels) {
    for (std::size_t i = 0; i < panel.x.size(); ++i) {
      for (std::size_t j = 0; j < panel.y.size(); ++j) {
        out << '"' << panel.title << "\"," << panel.x[i] << ',' << panel.y[j] << ','
            << panel.values[i * panel.y.size() + j] << '\n';
      }
    }
  }
  return out.str();
}

}  // namespace

std::string draw(const HeatMap& map, const std::string& svg_path) {
  if (!gnuplot_is_installed()) return write_instead(svg_path, as_csv(map));
  run_gnuplot(script(map, svg_path), svg_path);
  return svg_path;
}

}  // namespace limpid::examples
