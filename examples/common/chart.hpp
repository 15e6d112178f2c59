// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace limpid::examples {

/// One curve of a panel.
struct Curve {
  std::string name;
  std::vector<double> x, y;
  bool dashed = false;
  int colour = 0;  ///< of the palette, from 1; 0: the next one
};

/// One set of axes; panels of a chart stand below one another.
struct Panel {
  std::string title, x_label, y_label;
  std::vector<Curve> curves;
  bool logarithmic = false;    ///< the y axis
  bool logarithmic_x = false;  ///< the x axis
};

struct Chart {
  std::string title;
  std::vector<Panel> panels;
};

/// Draws `chart` into an SVG file with gnuplot. Where gnuplot is absent, says so on standard error and writes the
/// curves as CSV beside it.
/// @returns the path of the file that was written
/// @throws std::runtime_error  where neither can be written
std::string draw(const Chart& chart, const std::string& svg_path);

}  // namespace limpid::examples
