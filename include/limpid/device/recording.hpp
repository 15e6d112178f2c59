// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/time.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <istream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace limpid {

/// A recorded force as a function of time, from a CSV file whose first two columns are time (s) and force.
///
/// Between the samples runs the monotone cubic of Fritsch and Butland (PCHIP): continuous with its derivative, and
/// never beyond the samples on either side. The first sample is at time zero; before it and after the last one,
/// their forces are held.
///
/// Lines may end in CR LF; lines that are blank or begin with # are passed over; the first other line may be a
/// header, whose first two cells look like no number; columns after the second are not read. The times must increase,
/// evenly or not.
/// @realtime  at: no allocation, no throw; O(log n)
class Recording {
 public:
  struct Settings {
    double scale = 1;  ///< newtons per unit of the file's force; finite
  };

  /// @throws std::invalid_argument  where the scale is not finite
  /// @throws std::runtime_error     "press.csv: line 3, column 2: expected a finite number, got ..."
  [[nodiscard]] static Recording load(const std::string& path, const Settings& settings) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(path + ": cannot be opened");
    return parse(file, path, settings);
  }
  [[nodiscard]] static Recording load(const std::string& path) { return load(path, Settings{}); }

  /// @param name  stands for the file in errors, which are those of `load`
  [[nodiscard]] static Recording parse(std::istream& text, const std::string& name, const Settings& settings) {
    expect(std::isfinite(settings.scale), "Recording: scale", "finite", settings.scale);
    Recording recording;
    std::string line;
    bool header_allowed = true;
    for (std::size_t number = 1; std::getline(text, line); ++number) {
      const std::string_view row = content(line, number);
      if (row.empty() || row.front() == '#') continue;
      if (!(header_allowed && is_header(row))) recording.append(row, Place{name, number}, settings.scale);
      header_allowed = false;
    }
    if (text.bad()) throw std::runtime_error(name + ": cannot be read");
    if (recording.times_.size() < 2) throw std::runtime_error(name + ": expected two samples or more");
    const double start = recording.times_.front();
    for (double& time : recording.times_) time -= start;
    if (!(recording.times_.back() < longest)) throw std::runtime_error(name + ": expected less than a year of samples");
    recording.find_slopes();
    if (!recording.is_finite_between()) {
      throw std::runtime_error(name + ": expected forces whose slopes are finite");
    }
    return recording;
  }
  [[nodiscard]] static Recording parse(std::istream& text, const std::string& name) {
    return parse(text, name, Settings{});
  }

  /// Force, N, at `time` since the first sample.
  [[nodiscard]] double at(Time time) const noexcept {
    const double t = in_seconds(time);
    if (t <= times_.front()) return forces_.front();
    if (t >= times_.back()) return forces_.back();
    const auto after = std::upper_bound(times_.begin(), times_.end(), t);
    const auto k = static_cast<std::size_t>(after - times_.begin()) - 1;
    const double h = times_[k + 1] - times_[k], s = (t - times_[k]) / h;
    const Cubic cubic = cubic_after(k);
    return forces_[k] + h * s * (slopes_[k] + s * (cubic.second + s * cubic.third));
  }

  /// From the first sample to the last.
  [[nodiscard]] Duration duration() const noexcept { return from_seconds(times_.back()); }

  [[nodiscard]] std::size_t size() const noexcept { return times_.size(); }

 private:
  struct Place {
    const std::string& name;
    std::size_t line;
  };

  struct Cubic {
    double second, third;  // of the way through the interval, N/s
  };

  static constexpr double longest = 366 * 86400.0;  // s: a nanosecond count and a double still resolve each other

  Recording() = default;

  [[noreturn]] static void refuse(const Place& place, int column, std::string_view expected, std::string_view actual) {
    throw std::runtime_error(place.name + ": line " + std::to_string(place.line) + ", column " +
                             std::to_string(column) + ": expected " + std::string(expected) + ", got " +
                             (actual.empty() ? "nothing" : '"' + std::string(actual) + '"'));
  }

  static std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r";
    const std::size_t first = text.find_first_not_of(blank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blank) - first + 1);
  }

  // The line without its ends and, on the first one, without a byte order mark.
  static std::string_view content(std::string_view line, std::size_t number) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    if (number == 1 && line.substr(0, mark.size()) == mark) line.remove_prefix(mark.size());
    return trimmed(line);
  }

  static std::pair<std::string_view, std::string_view> first_two(std::string_view row) {
    const std::size_t end = row.find(',');
    if (end == std::string_view::npos) return {trimmed(row), {}};
    const std::string_view rest = row.substr(end + 1);
    return {trimmed(row.substr(0, end)), trimmed(rest.substr(0, rest.find(',')))};
  }

  static bool is_number(std::string_view cell, double& value) {
    if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    return error == std::errc{} && end == cell.data() + cell.size() && std::isfinite(value);
  }

  // Whether a cell is meant as a number, be it a broken one.
  static bool looks_numeric(std::string_view cell) {
    if (cell.empty()) return false;
    if (std::string_view("+-.0123456789").find(cell.front()) != std::string_view::npos) return true;
    std::string lower(cell);
    for (char& c : lower) c = 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return lower == "nan" || lower == "inf" || lower == "infinity";
  }

  static bool is_header(std::string_view row) {
    const auto [time, force] = first_two(row);
    return !time.empty() && !looks_numeric(time) && !looks_numeric(force);
  }

  void append(std::string_view row, const Place& place, double scale) {
    const auto [time_cell, force_cell] = first_two(row);
    double time = 0, force = 0;
    if (!is_number(time_cell, time)) refuse(place, 1, "a finite number", time_cell);
    if (!is_number(force_cell, force)) refuse(place, 2, "a finite number", force_cell);
    if (!times_.empty() && !(time > times_.back())) refuse(place, 1, "a time after the one before", time_cell);
    if (!std::isfinite(force * scale)) refuse(place, 2, "a force that stays finite with the scale", force_cell);
    times_.push_back(time);
    forces_.push_back(force * scale);
  }

  void find_slopes() {
    const std::size_t n = times_.size();
    slopes_.assign(n, (forces_[1] - forces_[0]) / (times_[1] - times_[0]));
    if (n == 2) return;
    for (std::size_t k = 1; k + 1 < n; ++k) slopes_[k] = inner_slope(k);
    slopes_[0] = end_slope(0, 1, 2);
    slopes_[n - 1] = end_slope(n - 1, n - 2, n - 3);
  }

  [[nodiscard]] Cubic cubic_after(std::size_t k) const noexcept {
    const double rise = secant(k, k + 1);
    return {.second = 3 * rise - 2 * slopes_[k] - slopes_[k + 1], .third = slopes_[k] + slopes_[k + 1] - 2 * rise};
  }

  // Whether no sum of `at` can overflow.
  [[nodiscard]] bool is_finite_between() const noexcept {
    for (std::size_t k = 0; k + 1 < times_.size(); ++k) {
      const Cubic cubic = cubic_after(k);
      const double h = times_[k + 1] - times_[k];
      const double most = std::abs(slopes_[k]) + std::abs(cubic.second) + std::abs(cubic.third);
      if (!std::isfinite(std::abs(slopes_[k + 1]) + std::abs(forces_[k]) + most * std::max(h, 1.0))) return false;
    }
    return true;
  }

  [[nodiscard]] double secant(std::size_t a, std::size_t b) const noexcept {
    return (forces_[b] - forces_[a]) / (times_[b] - times_[a]);
  }

  // Weighted harmonic mean of the secants on both sides; zero at an extremum.
  [[nodiscard]] double inner_slope(std::size_t k) const {
    const double before = secant(k - 1, k), after = secant(k, k + 1);
    if (!(before * after > 0)) return 0;
    const double h0 = times_[k] - times_[k - 1], h1 = times_[k + 1] - times_[k];
    const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
    return (w0 + w1) / (w0 / before + w1 / after);
  }

  // Slope at the end `a` of the parabola through three samples, limited so that the end stays monotone.
  [[nodiscard]] double end_slope(std::size_t a, std::size_t b, std::size_t c) const {
    const double near = secant(a, b), far = secant(b, c);
    const double h0 = times_[b] - times_[a], h1 = times_[c] - times_[b];  // both negative at the last sample
    const double slope = ((2 * h0 + h1) * near - h0 * far) / (h0 + h1);
    if (!(slope * near > 0)) return 0;
    return near * far < 0 && std::abs(slope) > 3 * std::abs(near) ? 3 * near : slope;
  }

  std::vector<double> times_;   // s, the first one zero
  std::vector<double> forces_;  // N
  std::vector<double> slopes_;  // N/s
};

}  // namespace limpid
