// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace limpid::examples {

[[nodiscard]] bool gnuplot_is_installed();

/// A gnuplot string between single quotes.
/// @throws std::runtime_error  where `text` has a control character
[[nodiscard]] std::string quoted(const std::string& text);

/// The commands that send an SVG of this size to a file.
[[nodiscard]] std::string svg_terminal(int width, int height, const std::string& svg_path);

/// Runs a script that writes `svg_path`.
/// @throws std::runtime_error  where the file was not written whole
void run_gnuplot(const std::string& script, const std::string& svg_path);

/// Says on standard error that gnuplot is absent and writes the data beside where the plot would be.
/// @returns the path of the CSV file
/// @throws std::runtime_error  where it cannot be written
std::string write_instead(const std::string& svg_path, const std::string& csv);

}  // namespace limpid::examples
