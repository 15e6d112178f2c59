// SPDX-License-Identifier: MIT
#include "gnuplot.hpp"

#include "output_file.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace limpid::examples {

namespace {

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

bool gnuplot_is_installed() { return std::system("command -v gnuplot >/dev/null 2>&1") == 0; }

// A quote is doubled; a line break would end the string, and the command.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) throw std::runtime_error("a chart's text has a control character");
    result += c;
    if (c == '\'') result += c;
  }
  return result + "'";
}

std::string svg_terminal(int width, int height, const std::string& svg_path) {
  return "set terminal svg size " + std::to_string(width) + "," + std::to_string(height) +
         " dynamic background 'white' font 'sans,12'\nset output " + quoted(svg_path) + "\n";
}

void run_gnuplot(const std::string& script, const std::string& svg_path) {
  write_file(svg_path, "");
  FILE* gnuplot = ::popen("gnuplot", "w");
  if (gnuplot == nullptr) throw std::runtime_error("gnuplot: cannot be started");
  const bool written = std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
  if (::pclose(gnuplot) != 0 || !written || !is_whole_svg(svg_path)) {
    throw std::runtime_error(svg_path + ": gnuplot failed");
  }
}

std::string write_instead(const std::string& svg_path, const std::string& csv) {
  const std::string csv_path = std::filesystem::path(svg_path).replace_extension(".curves.csv").string();
  write_file(csv_path, csv);
  std::cerr << "gnuplot is not installed (Debian: gnuplot-nox): the curves are in " << csv_path << '\n';
  return csv_path;
}

}  // namespace limpid::examples
