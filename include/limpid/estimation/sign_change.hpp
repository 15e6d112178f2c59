// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <algorithm>

namespace limpid::detail {

/// Where a step meets a change of sign.
template <typename Point, Real Scalar>
struct SignChange {
  bool changed = false;  ///< else: the whole step has one sign
  Scalar part{0};        ///< of the step, just beyond the change
  Point end{};           ///< there
};

/// Finds where along a step a quantity that begins above zero (`positive`) or not ends so: by false position, weighted
/// (Illinois), to 1e-9 of the step, in twenty evaluations at most.
/// @param after  the point after a part of the step, 0 to length
/// @param of     the quantity at a point
/// @realtime     as those, no allocation, no throw
template <typename Scalar, typename After, typename Quantity>
[[nodiscard]] auto sign_change(const Scalar& length, bool positive, const After& after, const Quantity& of) noexcept {
  SignChange<decltype(after(length)), Scalar> found{.changed = false, .part = length, .end = after(length)};
  Scalar beyond = of(found.end);
  if ((beyond > Scalar{0}) == positive) return found;
  found.changed = true;
  Scalar before{0}, value = of(after(before));
  if ((value > Scalar{0}) != positive) value = Scalar{0};  // of the change that the step before ended with
  int kept = 0;                                            // how often in turn an end stayed, negative: the first
  for (int i = 0; i < 20 && found.part - before > length / Scalar(1'000'000'000); ++i) {
    const Scalar least = Scalar(1) / Scalar(20), share = value / (value - beyond);
    const Scalar part = before + (found.part - before) * std::clamp(share, least, Scalar{1} - least);
    const auto point = after(part);
    const Scalar here = of(point);
    if ((here > Scalar{0}) == positive) {
      before = part;
      value = here;
      kept = kept > 0 ? kept + 1 : 1;
      if (kept > 1) beyond /= Scalar{2};
    } else {
      found.part = part;
      found.end = point;
      beyond = here;
      kept = kept < 0 ? kept - 1 : -1;
      if (kept < -1) value /= Scalar{2};
    }
  }
  return found;
}

}  // namespace limpid::detail
