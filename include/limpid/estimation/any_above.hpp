// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/any_lane.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>

namespace limpid {

/// Whether an entry is above `bound`, without a branch for each: in whole packets by one test of the comparisons'
/// signs, else by one sum of the excesses.
/// @realtime  no allocation, no throw
template <typename Array>
[[nodiscard]] EIGEN_ALWAYS_INLINE bool any_above(const Array& values, const typename Array::Scalar& bound) noexcept {
  using Scalar = typename Array::Scalar;
  if constexpr (detail::in_packets<Array>) {
    return detail::any_entry(
        [&](auto& mask, const auto& v) __attribute__((always_inline)) { mask = v > bound; }, values);
  } else {
    return (values - bound).max(Scalar{0}).sum() > Scalar{0};
  }
}

}  // namespace limpid
