// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/estimation/axis_sample.hpp>
#include <limpid/estimation/noise_levels.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid {

/// What samples say of a tissue's edge. Where the tool moves over some samples, and their forces come to less than half
/// of what any tissue would push with whose damping could not have cancelled it, there is none: the tissue begins at an
/// edge. Where it pulls, in two samples one after the other, it has no edge.
/// @realtime  no allocation, no throw for built-in scalars
template <Real Scalar = double>
class ContactEdge {
 public:
  struct Guess {
    Scalar at, deviation;  // m
  };

  /// What is taken for a tissue: one at least as stiff, and damped at most so.
  struct Tissue {
    Scalar slope, damping;  // N/m, N s/m
  };

  /// @return  whether the tissue pushes, beyond noise
  bool feel(const AxisSample<Scalar>& z, const Tissue& least) noexcept {
    using std::abs, std::sqrt;
    const Scalar noise = Scalar(4) * sqrt(noise_.variance());
    count_pulls(z.force < -noise);
    if (abs(z.force) > noise) {
      row_ = 0;
      if (z.force > noise) pressed_from_ = std::min(pressed_from_, z.x);
      return z.force > noise;
    }
    lengthen_row(z, least);
    if (free_) noise_.observe(z.force, Scalar{0});
    return false;
  }

  /// Whether there is one.
  [[nodiscard]] bool exists() const noexcept { return exists_ && pulls_ < 2; }

  /// The shallowest depth with force, m; since `begin_at`.
  [[nodiscard]] Scalar pressed_from() const noexcept { return pressed_from_; }
  void begin_at(const Scalar& x) noexcept { pressed_from_ = x; }

  /// @param z        a sample with force
  /// @param slope    of the tissue, N/m, as it is believed before anything is known
  /// @param damping  N s/m, likewise
  [[nodiscard]] Guess guess(const AxisSample<Scalar>& z, const Scalar& slope, const Scalar& damping) const noexcept {
    const Scalar pressed = std::max(z.force - damping * std::max(z.v, Scalar{0}), z.force / Scalar{10}) / slope;
    // where it was free deeper than that before, the edge has moved
    const Scalar room = z.x > free_to_ ? std::max(z.x - free_to_, Scalar(1) / Scalar(100000)) : pressed;
    const Scalar depth = std::min(pressed, room), deviation = std::min(std::max(depth, room - depth), pressed);
    return {z.x - depth, deviation};
  }

 private:
  static constexpr Scalar nowhere() noexcept { return std::numeric_limits<Scalar>::max(); }

  // Two in a row end the edge; five rows without force that show one, and no pull between them, bring it back.
  void count_pulls(bool pulls) noexcept {
    if (pulls) {
      pulls_ = std::min(pulls_ + 1, 2);
      free_rows_ = 0;
    } else if (pulls_ < 2 || free_rows_ >= 5) {
      pulls_ = 0;
    }
  }

  void lengthen_row(const AxisSample<Scalar>& z, const Tissue& least) noexcept {
    using std::abs;
    if (row_++ == 0) begin_row(z);
    const Scalar dx = z.x - from_.x, dv = z.v - from_.v;
    const Scalar cancelled = dx * dv < Scalar{0} ? least.damping * abs(dv) : Scalar{0};
    force_ += abs(z.force);
    expected_ += std::max(least.slope * abs(dx) - cancelled, Scalar{0});
    if (!free_ && abs(dx) > Scalar(5) / Scalar(100000) && force_ < expected_ / Scalar{2}) {
      free_ = exists_ = true;
      free_rows_ = std::min(free_rows_ + 1, 5);
    }
    if (free_ && z.v >= Scalar{0}) free_to_ = std::max(free_to_, z.x);
  }

  void begin_row(const AxisSample<Scalar>& z) noexcept {
    free_to_ = -nowhere();
    free_ = false;
    from_ = z;
    force_ = expected_ = Scalar{0};
  }

  NoiseLevels<6, Scalar> noise_{{Scalar(1e-4), Scalar(1e-3), Scalar(3e-3), Scalar(1e-2), Scalar(3e-2), Scalar(1e-1)},
                                Scalar(98) / Scalar(100)};
  AxisSample<Scalar> from_{};        // the first in a row of samples without force
  Scalar force_{0}, expected_{0};    // the row's forces; of a tissue that it could be, at least; N
  Scalar free_to_ = -nowhere();      // the deepest of the row at which it moved deeper, m
  Scalar pressed_from_ = nowhere();  // the shallowest with force, m
  int row_ = 0, free_rows_ = 0;      // how many of such a row; of rows that showed an edge, since a pull
  int pulls_ = 0;                    // in a row, at most 2
  bool free_ = false, exists_ = false;
};

}  // namespace limpid
