// SPDX-License-Identifier: MIT
#pragma once

#include "random.hpp"
#include "trial.hpp"

#include <limpid/core/time.hpp>

#include <limits>

namespace limpid::stress {

/// What happens to a number now and then.
enum class CorruptionKind {
  none,
  not_finite,  ///< NaN or an infinity
  absurd,      ///< finite, from the smallest to the largest number
};

inline Choice corruption_choice() { return {"corruption", {"none", "not finite", "absurd"}}; }

class Corruption {
 public:
  explicit Corruption(int kind, double probability = 0.001)
      : kind_{static_cast<CorruptionKind>(kind)}, probability_{probability} {}

  /// `value`, or what has become of it.
  template <typename Scalar>
  Scalar operator()(Scalar value, Random& random) const {
    using Limits = std::numeric_limits<Scalar>;
    const bool hit = random.chance(probability_);
    const int which = random.below(4);
    if (!hit || kind_ == CorruptionKind::none) return value;
    if (kind_ == CorruptionKind::absurd) {
      return Scalar(random.decades(Limits::min_exponent10, Limits::max_exponent10));
    }
    return which == 0 ? Limits::infinity() : which == 1 ? -Limits::infinity() : Limits::quiet_NaN();
  }

  [[nodiscard]] bool any() const { return kind_ != CorruptionKind::none; }

 private:
  CorruptionKind kind_;
  double probability_;
};

/// What happens to samples on their way.
enum class LineKind {
  perfect,
  lossy,     ///< one in four is lost
  repeated,  ///< one in four comes again, with the same stamp
  shuffled,  ///< stamps up to 200 ms old, in no order
  insane,    ///< all of these, stamps in the future, and arrivals before they were taken
};

inline Choice line_choice() { return {"line", {"perfect", "lossy", "repeated", "shuffled", "insane"}}; }

/// The stamps of one sample.
struct Stamps {
  bool lost;
  Time taken, arrived;
};

class Line {
 public:
  explicit Line(int kind) : kind_{static_cast<LineKind>(kind)} {}

  /// Of a sample taken `age` before it arrives now.
  Stamps carry(Time now, Duration age, Random& random) {
    const bool hit = random.chance(0.25);
    const int which = random.below(5);
    const Duration stray{static_cast<Duration::rep>(random.uniform(0, 2e8))};
    Stamps stamps{false, now - age, now};
    const bool insane = kind_ == LineKind::insane;
    if (hit && (kind_ == LineKind::lossy || (insane && which == 0))) stamps.lost = true;
    if (hit && (kind_ == LineKind::repeated || (insane && which == 1))) stamps.taken = last_;
    if (kind_ == LineKind::shuffled || (insane && which == 2)) stamps.taken = now - stray;
    if (hit && insane && which == 3) stamps.taken = stamps.arrived = now + stray;
    if (hit && insane && which == 4) stamps.arrived = stamps.taken - stray;
    last_ = stamps.taken;
    return stamps;
  }

 private:
  LineKind kind_;
  Time last_{};
};

}  // namespace limpid::stress
