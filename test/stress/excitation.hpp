// SPDX-License-Identifier: MIT
#pragma once

#include "random.hpp"
#include "trial.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace limpid::stress {

/// What a regressor, a force or a motion does over time.
enum class ExcitationKind {
  rich,       ///< independent entries of one size
  absent,     ///< zero
  weak,       ///< a slow sine, a millionth as large
  collinear,  ///< always along one direction: windup across it
  bursts,     ///< by blocks of 64 ticks of sizes e^-14 to e^5, every fifth one zero
  denormal,   ///< below the smallest normal number
  huge,       ///< up to a square root of the largest number, and beyond it now and then
};

inline Choice excitation_choice() {
  return {"excitation", {"rich", "absent", "weak", "collinear", "bursts", "denormal", "huge"}};
}

/// Entries of about one size, by kind.
template <int Entries, typename Scalar>
class Excitation {
 public:
  using Row = std::array<Scalar, Entries>;

  explicit Excitation(int kind) : kind_{static_cast<ExcitationKind>(kind)} {}

  Row next(Random& random) {
    if (tick_++ % 64 == 0) {
      idle_ = random.chance(0.2);
      for (double& size : sizes_) size = std::exp(random.uniform(-14, 5));
    }
    Row row;
    for (std::size_t j = 0; j < Entries; ++j) row[j] = Scalar(entry(j, random));
    return row;
  }

 private:
  using Limits = std::numeric_limits<Scalar>;

  double entry(std::size_t j, Random& random) {
    const double draw = random.uniform(-1, 1), time = 1e-3 * double(tick_), place = double(j);
    switch (kind_) {
      case ExcitationKind::rich:
        return draw;
      case ExcitationKind::absent:
        return 0;
      case ExcitationKind::weak:
        return 1e-6 * std::sin(time * (1 + place) + place);
      case ExcitationKind::collinear:
        return std::sin(7 * time) * (1 + 0.7 * place);
      case ExcitationKind::bursts:
        return idle_ ? 0 : draw * sizes_[j];
      case ExcitationKind::denormal:
        return std::round(100 * draw) * double(Limits::denorm_min());
      case ExcitationKind::huge:
        return draw * std::pow(10.0, random.uniform(-2, random.chance(0.01) ? 1 : 0.5) * Limits::max_exponent10);
    }
    return 0;
  }

  ExcitationKind kind_;
  std::uint64_t tick_ = 0;
  bool idle_ = false;
  std::array<double, Entries> sizes_{};
};

}  // namespace limpid::stress
