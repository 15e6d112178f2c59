// SPDX-License-Identifier: MIT
#include "weights_file.hpp"

#include "number_list.hpp"

#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace limpid::examples {

namespace {

constexpr std::array<const char*, 7> columns{"dx", "dy", "dz", "load", "cx", "cy", "cz"};

struct Place {
  const std::string& name;
  std::size_t line;
};

[[noreturn]] void refuse_cell(const Place& place, const std::string& field, const std::string& expected,
                              const std::string& actual) {
  throw std::runtime_error(place.name + ": line " + std::to_string(place.line) + ", " + field + ": expected " +
                           expected + ", got " + (actual.empty() ? "nothing" : '"' + actual + '"'));
}

std::string trimmed(const std::string& text) {
  constexpr const char* blank = " \t\r";
  const std::size_t first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::size_t begin = 0, end = 0;
  do {
    end = row.find(',', begin);
    cells.push_back(trimmed(row.substr(begin, end == std::string::npos ? end : end - begin)));
    begin = end + 1;
  } while (end != std::string::npos);
  return cells;
}

bool is_header(const std::vector<std::string>& cells) {
  for (const std::string& cell : cells) {
    if (cell.empty() || std::isalpha(static_cast<unsigned char>(cell.front())) == 0 || number_of(cell)) return false;
  }
  return true;
}

CalibrationLoad<> load_of(const std::vector<std::string>& cells, const Place& place) {
  if (cells.size() != columns.size()) {
    refuse_cell(place, "columns", "7: dx, dy, dz, load, cx, cy, cz", std::to_string(cells.size()));
  }
  std::array<double, columns.size()> values{};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto value = number_of(cells[i]);
    if (!value) refuse_cell(place, columns[i], "a finite number", cells[i]);
    if (i == 3 && std::abs(*value) > 1e4) refuse_cell(place, columns[i], "N of at most 1e4 in magnitude", cells[i]);
    if (i > 3 && std::abs(*value) > 65536) refuse_cell(place, columns[i], "counts within 65536 of 0", cells[i]);
    values[i] = *value;
  }
  const Eigen::Vector3d direction(values[0], values[1], values[2]);
  const double length = direction.stableNorm();
  if (!(length > 0) && values[3] != 0) {
    refuse_cell(place, "dx, dy, dz", "a direction of the load", cells[0] + ", " + cells[1] + ", " + cells[2]);
  }
  CalibrationLoad<> load;
  if (length > 0) load.force = values[3] * (direction / length);
  load.counts << values[4], values[5], values[6];
  return load;
}

}  // namespace

std::vector<CalibrationLoad<>> parse_weights(std::istream& text, const std::string& name) {
  std::vector<CalibrationLoad<>> loads;
  std::string line;
  bool header_allowed = true;
  for (std::size_t number = 1; std::getline(text, line); ++number) {
    const std::string row = trimmed(line);
    if (row.empty() || row.front() == '#') continue;
    const auto cells = cells_of(row);
    if (!(header_allowed && is_header(cells))) loads.push_back(load_of(cells, {name, number}));
    header_allowed = false;
  }
  if (text.bad()) throw std::runtime_error(name + ": cannot be read");
  return loads;
}

std::vector<CalibrationLoad<>> load_weights(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  return parse_weights(file, path);
}

std::string as_csv(const std::vector<CalibrationLoad<>>& loads) {
  std::ostringstream text;
  text.precision(17);
  text << "dx,dy,dz,load_N,cx,cy,cz\n";
  for (const auto& [force, counts] : loads) {
    const double load = force.norm();
    const Eigen::Vector3d direction = load > 0 ? Eigen::Vector3d(force / load) : Eigen::Vector3d::UnitX();
    for (const double value : direction) text << value << ',';
    text << load << ',' << counts[0] << ',' << counts[1] << ',' << counts[2] << '\n';
  }
  return text.str();
}

}  // namespace limpid::examples
