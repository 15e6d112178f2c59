// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

namespace limpid {

/// Whether an entry is above `bound`, by one sum of the excesses: no branch and no reduction by comparison, for which
/// Eigen has no packets.
/// @realtime  no allocation, no throw
template <typename Array>
[[nodiscard]] EIGEN_ALWAYS_INLINE bool any_above(const Array& values, const typename Array::Scalar& bound) noexcept {
  using Scalar = typename Array::Scalar;
  return (values - bound).max(Scalar{0}).sum() > Scalar{0};
}

}  // namespace limpid
