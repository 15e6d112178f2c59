// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <concepts>
#include <cstring>

namespace limpid {

/// How many lanes hold `axes` axes: three axes of float or double take a fourth, which
/// fills whole packets and repeats the third: whatever holds for the axes holds for it.
template <Real Scalar>
[[nodiscard]] constexpr int lanes_for(int axes) noexcept {
  return axes == 3 && (std::same_as<Scalar, float> || std::same_as<Scalar, double>) ? 4 : axes;
}

/// Axes side by side, one a lane. Neither the number of lanes nor their alignment depends on compiler flags, so that
/// translation units compiled for different processors share one layout.
template <int Axes, Real Scalar>
using Lanes = Eigen::Array<Scalar, lanes_for<Scalar>(Axes), 1, Eigen::DontAlign>;

/// The axes of `values`, with the last one again in a lane beyond them.
template <int Axes, typename Derived>
[[nodiscard]] Lanes<Axes, typename Derived::Scalar> to_lanes(const Eigen::ArrayBase<Derived>& values) noexcept {
  if constexpr (lanes_for<typename Derived::Scalar>(Axes) == Axes) {
    return values;
  } else {
    using Scalar = typename Derived::Scalar;
    using Register [[gnu::vector_size(4 * sizeof(Scalar))]] = Scalar;  // joined there: through memory it would stall
    const auto& v = values.derived();
    const Register joined{v[0], v[1], v[2], v[2]};
    Lanes<Axes, Scalar> lanes;
    std::memcpy(lanes.data(), &joined, sizeof joined);
    return lanes;
  }
}

}  // namespace limpid
