// SPDX-License-Identifier: MIT
#pragma once

#include "random.hpp"
#include "trial.hpp"

#include <limpid/core/time.hpp>

#include <cmath>

namespace limpid::stress {

/// How time goes on from tick to tick.
enum class ClockKind {
  steady,     ///< 1 ms
  jitter,     ///< 0 to 50 ms, often 0
  backwards,  ///< jitter, and now and then back by up to a second
  pauses,     ///< 1 ms, and now and then up to an hour, or a nanosecond
};

inline Choice clock_choice() { return {"clock", {"steady", "jitter", "backwards", "pauses"}}; }

class Clock {
 public:
  explicit Clock(int kind) : kind_{static_cast<ClockKind>(kind)} {}

  /// The next tick's length, s; also 0 or less.
  double length(Random& random) {
    const double coin = random.uniform(0, 1), part = random.uniform(0, 1);
    switch (kind_) {
      case ClockKind::steady:
        return 1e-3;
      case ClockKind::jitter:
        return coin < 0.1 ? 0 : 0.05 * part;
      case ClockKind::backwards:
        return coin < 0.05 ? -part : 0.05 * part;
      case ClockKind::pauses:
        return coin < 0.001 ? 3600 * part : coin < 0.01 ? 1e-9 : 1e-3;
    }
    return 1e-3;
  }

  /// The next tick.
  Time next(Random& random) {
    now_ += Duration{std::llround(1e9 * length(random))};
    return now_;
  }

 private:
  ClockKind kind_;
  Time now_{};
};

}  // namespace limpid::stress
