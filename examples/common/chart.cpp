// SPDX-License-Identifier: MIT
#include "chart.hpp"
#include "output_file.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

namespace limpid::examples {

namespace {

bool gnuplot_is_installed() { return std::system("command -v gnuplot >/dev/null 2>&1") == 0; }

// A gnuplot string between single quotes: a quote is doubled; a line break would end it, and the command.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) throw std::runtime_error("a chart's text has a control character");
    result += c;
    if (c == '\'') result += c;
  }
  return result + "'";
}

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
      << (panel.logarithmic ? "set logscale y\n" : "unset logscale y\n") << "plot ";
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
  out << "set terminal svg size 960," << 60 + 270 * chart.panels.size()
      << " dynamic background 'white' font 'sans,12'\nset output " << quoted(svg_path) << '\n';
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

// gnuplot tells of a full disk neither by its exit code nor in words.
bool is_whole_svg(const std::string& path) {
  std::ifstream file(path);
  std::string last, line;
  while (std::getline(file, line)) {
    if (!line.empty()) last = line;
  }
  return last.find("</svg>") != std::string::npos;
}

}  // namespace

std::string draw(const Chart& chart, const std::string& svg_path) {
  if (!gnuplot_is_installed()) {
    const std::string csv_path = std::filesystem::path(svg_path).replace_extension(".curves.csv").string();
    write_file(csv_path, as_csv(chart));
    std::cerr << "gnuplot is not installed (Debian: gnuplot-nox): the curves are in " << csv_path << '\n';
    return csv_path;
  }
  write_file(svg_path, "");
  const std::string text = script(chart, svg_path);
  FILE* gnuplot = ::popen("gnuplot", "w");
  if (gnuplot == nullptr) throw std::runtime_error("gnuplot: cannot be started");
  const bool written = std::fwrite(text.data(), 1, text.size(), gnuplot) == text.size();
  if (::pclose(gnuplot) != 0 || !written || !is_whole_svg(svg_path)) {
    throw std::runtime_error(svg_path + ": gnuplot failed");
  }
  return svg_path;
}

}  // namespace limpid::examples
