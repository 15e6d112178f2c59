// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/time.hpp>

#include <functional>
#include <string>

namespace limpid::examples {

/// The operator's force along the press axis, N, positive into the wall.
struct PressForce {
  std::function<double(Time)> at;
  Duration duration;        ///< how long it is defined
  std::string description;  ///< for tables and plots
};

/// amplitude (1 - cos(2 pi frequency t)) / 2: pushes only. Amplitude in N, frequency in Hz.
[[nodiscard]] PressForce raised_cosine_force(double amplitude, double frequency, Duration duration);

/// amplitude sin(2 pi frequency t). Amplitude in N, frequency in Hz.
[[nodiscard]] PressForce sine_force(double amplitude, double frequency, Duration duration);

/// A recording (time in s, force in N), scaled, between its samples by monotone cubic interpolation.
/// @throws std::runtime_error  with file, line and column where the file cannot be read
[[nodiscard]] PressForce recorded_force(const std::string& path, double scale);

/// Ten presses of irregular strength and rhythm in 20 s, at most 3 N: serves where no recording is given.
[[nodiscard]] PressForce press_like_force();

}  // namespace limpid::examples
