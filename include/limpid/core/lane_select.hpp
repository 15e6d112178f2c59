// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/lane_math.hpp>
#include <limpid/core/lanes.hpp>

#include <Eigen/Core>

namespace limpid {

/// Of each entry `yes` where `of` > 0, else `no`: two to four entries of float or double without a branch, which an
/// axis that comes and goes would mislead.
/// @realtime  no allocation, no throw
template <typename Array>
[[nodiscard]] Array where_positive(const Array& of, const Array& yes, const Array& no) noexcept {
  constexpr int n = Array::SizeAtCompileTime;
  using Scalar = typename Array::Scalar;
  if constexpr (n > 1 && detail::in_lanes<Lanes<n, Scalar>>) {
    typename detail::Doubles<lanes_for<Scalar>(n)>::Value c, a, b;
    detail::load(c, to_lanes<n>(of));
    detail::load(a, to_lanes<n>(yes));
    detail::load(b, to_lanes<n>(no));
    const decltype(c) chosen = c > 0.0 ? a : b;
    return detail::stored<Lanes<n, Scalar>>(chosen).template head<n>();
  } else {
    return (of > Scalar{0}).select(yes, no);
  }
}

}  // namespace limpid
