// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <cmath>
#include <limits>

namespace limpid::detail {

/// What a delay is beyond whole periods, s; a fraction that is but the rounding of the two numbers, as of .017 s in
/// periods of .001 s, counts as none.
template <Real Scalar>
[[nodiscard]] Scalar delay_fraction(const Scalar& delay, const Scalar& period) {
  using std::fmod;
  const Scalar rest = fmod(delay, period), rounding = Scalar(16) * std::numeric_limits<Scalar>::epsilon() * delay;
  return rest <= rounding || period - rest <= rounding ? Scalar{0} : rest;
}

/// Whole periods of a delay: delay = delay_periods period + delay_fraction.
template <Real Scalar>
[[nodiscard]] int delay_periods(const Scalar& delay, const Scalar& period) {
  using std::round;
  return static_cast<int>(round((delay - delay_fraction(delay, period)) / period));
}

}  // namespace limpid::detail
