// SPDX-License-Identifier: MIT
#include "press_force.hpp"

#include <limpid/device/recording.hpp>

#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>
#include <utility>

namespace limpid::examples {

namespace {

std::string with_unit(const char* shape, double amplitude, double frequency) {
  std::ostringstream text;
  text << shape << ", " << amplitude << " N, " << frequency << " Hz";
  return text.str();
}

PressForce from_recording(Recording recording, std::string description) {
  const auto shared = std::make_shared<const Recording>(std::move(recording));
  return {[shared](Time t) { return shared->at(t); }, shared->duration(), std::move(description)};
}

}  // namespace

PressForce raised_cosine_force(double amplitude, double frequency, Duration duration) {
  const double omega = 2 * std::numbers::pi * frequency;
  return {[=](Time t) { return amplitude * (1 - std::cos(omega * in_seconds(t))) / 2; }, duration,
          with_unit("raised cosine", amplitude, frequency)};
}

PressForce sine_force(double amplitude, double frequency, Duration duration) {
  const double omega = 2 * std::numbers::pi * frequency;
  return {[=](Time t) { return amplitude * std::sin(omega * in_seconds(t)); }, duration,
          with_unit("sine", amplitude, frequency)};
}

PressForce recorded_force(const std::string& path, double scale) {
  return from_recording(Recording::load(path, {.scale = scale}), path);
}

PressForce press_like_force() {
  // Drawn by hand after the look of recorded presses: quick rise, uneven plateau, slower release, short rests.
  std::istringstream knots(R"(time_s,force_N
0.00,0.00
0.30,0.02
0.62,1.55
0.85,1.72
1.30,0.10
1.75,0.03
2.02,2.10
2.30,2.32
2.55,1.95
3.05,0.05
3.60,0.02
3.95,2.75
4.30,2.96
4.95,0.22
5.30,0.04
5.70,1.20
6.40,1.42
6.95,0.06
7.60,0.03
7.90,2.45
8.15,2.30
8.75,0.12
9.20,0.05
9.60,2.85
10.40,2.60
11.10,0.08
11.90,0.02
12.15,1.85
12.45,2.02
13.00,0.15
13.35,0.06
13.70,2.55
14.00,2.98
14.70,0.04
15.60,0.02
16.05,0.95
16.90,1.10
17.30,0.05
17.60,0.04
17.92,2.66
18.20,2.40
18.90,0.07
20.00,0.02
)");
  return from_recording(Recording::parse(knots, "press-like force"), "built-in presses");
}

}  // namespace limpid::examples
