// SPDX-License-Identifier: MIT
#include "chart.hpp"
#include "gnuplot.hpp"

#include <sstream>

namespace limpid::examples {

namespace {

void write_data(std::ostream& out, const Chart& chart) {
  out.precision(10);
  for (std::size_t p = 0; p < chart.panels.size(); ++p) {
    for (std::size_t c = 0; c < chart.panels[p].curves.size(); ++c) {
      const Curve& curve = chart.panels[p].curves[c];
      out << "$data_" << p << '_' << c << " << END_OF_CURVE\n";
      for (std::size_t i = 0; i < curve.x.size(); ++i) out << curve.x[i] << ' ' << curve.y[i] << '\n';
      out << "END_OF_CURVE\n";
    }
  }
}

void write_panel(std::ostream& out, const Panel& panel, std::size_t index) {
  out << "set title " << quoted(panel.title) << " noenhanced\nset xlabel " << quoted(panel.x_label)
      << " noenhanced\nset ylabel " << quoted(panel.y_label) << " noenhanced\n"
      << (panel.logarithmic ? "set logscale y\n" : "unset logscale y\n")
      << (panel.logarithmic_x ? "set logscale x\n" : "unset logscale x\n") << "plot ";
  for (std::size_t c = 0; c < panel.curves.size(); ++c) {
    out << (c == 0 ? "" : ", ") << "$data_" << index << '_' << c << " using 1:2 with lines lw 1.4"
        << (panel.curves[c].dashed ? " dt 2" : "") << " lc "
        << (panel.curves[c].colour > 0 ? panel.curves[c].colour : static_cast<int>(c) + 1) << " title "
        << quoted(panel.curves[c].name) << " noenhanced";
  }
  out << '\n';
}

std::string script(const Chart& chart, const std::string& svg_path) {
  std::ostringstream out;
  out << svg_terminal(960, 60 + 270 * static_cast<int>(chart.panels.size()), svg_path);
  write_data(out, chart);
  out << "set grid\nset key outside right top\nset lmargin 12\nset rmargin 26\nset multiplot layout "
      << chart.panels.size() << ",1 title " << quoted(chart.title) << " noenhanced\n";
  for (std::size_t p = 0; p < chart.panels.size(); ++p) write_panel(out, chart.panels[p], p);
  out << "unset multiplot\n";
  return out.str();
}

std::string as_csv(const Chart& chart) {
  std::ostringstream out;
  out.precision(10);
  out << "panel,curve,x,y\n";
  for (const Panel& panel : chart.panels) {
    for (const Curve& curve : panel.curves) {
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        out << '"' << panel.title << "\",\"" << curve.name << "\"," << curve.x[i] << ',' << curve.y[i] << '\n';
      }
    }
  }
  return out.str();
}

}  // namespace

std::string draw(const Chart& chart, const std::string& svg_path) {
  if (!gnuplot_is_installed()) return write_instead(svg_path, as_csv(chart));
  run_gnuplot(script(chart, svg_path), svg_path);
  return svg_path;
}

}  // namespace limpid::examples
