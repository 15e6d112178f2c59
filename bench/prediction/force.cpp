// SPDX-License-Identifier: MIT
#include "prediction/force.hpp"

#include <limpid/device/recording.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string_view>

namespace limpid::bench {

namespace {

constexpr double peak = 3;  // N

const std::array<std::string_view, 3> held_out_recordings{"1cm_470ohms_full_stretch", "2cm_47ohms_full_stretch",
                                                          "4cm_47ohms_medium_stretch"};

double turns(double t, double frequency) { return 2 * std::numbers::pi * frequency * t; }

double raised_cosine(double t) { return peak / 2 * (1 - std::cos(turns(t, 0.5))); }

double sine(double t) { return peak * std::sin(turns(t, 0.5)); }

// Presses whose rhythm and depth wander.
double irregular(double t) {
  const double depth = 0.65 + 0.35 * std::sin(turns(t, 0.071) + 1);
  return peak / 2 * (1 - std::cos(turns(t, 0.45) + 1.1 * std::sin(turns(t, 0.13)))) * depth;
}

double highest(const Recording& recording) {
  double most = 0;
  for (Time t{}; t <= recording.duration(); t += std::chrono::milliseconds{1}) most = std::max(most, recording.at(t));
  return most;
}

Force recorded(const std::filesystem::path& path) {
  const double most = highest(Recording::load(path.string()));
  if (!(most > 0)) throw std::runtime_error(path.string() + ": expected a force above zero");
  const auto press = std::make_shared<const Recording>(Recording::load(path.string(), {.scale = peak / most}));
  constexpr std::string_view prefix = "press_";
  std::string name = path.stem().string();
  if (name.starts_with(prefix)) name.erase(0, prefix.size());
  const bool held_out = std::ranges::find(held_out_recordings, name) != held_out_recordings.end();
  return {std::move(name), [press](double t) { return press->at(from_seconds(t)); }, held_out};
}

}  // namespace

std::vector<Force> synthetic_forces() { return {{"cosine", raised_cosine}, {"sine", sine}, {"irregular", irregular}}; }

std::vector<Force> recorded_forces(const std::string& folder) {
  if (!std::filesystem::is_directory(folder)) throw std::runtime_error(folder + ": expected a folder of recordings");
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<Force> forces;
  forces.reserve(paths.size());
  for (const auto& path : paths) forces.push_back(recorded(path));
  if (forces.empty()) throw std::runtime_error(folder + ": has no recording (*.csv)");
  return forces;
}

}  // namespace limpid::bench
