// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace limpid::stress {

/// Steele and Vigna's splitmix64: fast, for hundreds of millions of ticks, and the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_{seed} {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * (double(bits() >> 11) * 0x1p-53); }

  /// 10^low to 10^high, of either sign.
  double decades(double low, double high) {
    const double size = std::pow(10.0, uniform(low, high));
    return chance(0.5) ? size : -size;
  }

  bool chance(double probability) { return uniform(0, 1) < probability; }

  /// 0 to count - 1.
  int below(int count) { return static_cast<int>(bits() % static_cast<std::uint64_t>(count)); }

 private:
  std::uint64_t state_;
};

}  // namespace limpid::stress
