// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace limpid::examples {

/// What the colours of a heat map mean.
struct ColourScale {
  std::string label{};
  double least = 0, most = 1;  ///< values beyond take the colour of the end
  bool regions = false;        ///< 0 blue, 1 yellow as in the thesis, 1/2 grey: no, yes, undecided
};

inline const ColourScale region_scale{.regions = true};

/// A value for each point of a uniform grid, as colours.
struct HeatPanel {
  std::string title, x_label, y_label;
  std::vector<double> x, y;    ///< rising, evenly spaced
  std::vector<double> values;  ///< of (x[i], y[j]) at i * y.size() + j; NaN is left white
  ColourScale scale{};
};

/// Panels stand side by side, `columns` in a row.
struct HeatMap {
  std::string title;
  std::vector<HeatPanel> panels;
  int columns = 2;
};

/// Draws `map` into an SVG file with gnuplot; where gnuplot is absent, says so on standard error and writes the values
/// as CSV beside it.
/// @returns the path of the file that was written
/// @throws std::runtime_error  where neither can be written
std::string draw(const HeatMap& map, const std::string& svg_path);

}  // namespace limpid::examples
