// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>

namespace limpid::examples {

/// How the slow environment sees and sends.
struct Sensing {
  double force_noise = 0, position_noise = 0, velocity_noise = 0;  ///< standard deviations, N, m, m/s
  double position_step = 0, force_step = 0;                        ///< quantisation, m, N; none: 0
  double jitter = 0;                                               ///< of an instant, at most, in periods
  double loss = 0;                                                 ///< probability

  bool operator==(const Sensing&) const = default;

  /// Whether anything is lost on the way.
  [[nodiscard]] bool any() const { return *this != Sensing{}; }
};

/// What a sample says of the tool.
struct SensedTool {
  double x = 0, v = 0, F_e = 0;  ///< m, m/s, N
};

/// Draws what becomes of each sample, one after the other; the same for the same seed.
class Sensor {
 public:
  Sensor(const Sensing& sensing, std::uint32_t seed) : sensing_{sensing}, random_{seed} {}

  /// Goes on to the next sample. The first one is taken on time.
  void draw();

  /// How far from its instant the sample is taken, in units of `period`'s.
  [[nodiscard]] double off(double period) const { return sensing_.jitter * period * off_; }
  [[nodiscard]] bool lost() const { return part_ < sensing_.loss; }
  [[nodiscard]] SensedTool sense(const SensedTool& truly) const;

 private:
  Sensing sensing_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_{-1, 1}, of_one_{0, 1};
  bool any_ = false;
  double off_ = 0, x_noise_ = 0, v_noise_ = 0, F_noise_ = 0, part_ = 1;
};

}  // namespace limpid::examples
