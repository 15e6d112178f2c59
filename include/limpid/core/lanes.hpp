// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <concepts>
#include <cstring>

namespace limpid {

/// How many lanes hold `axes` axes: three axes of float or double take a fourth, idle one, which fills whole packets.
template <Real Scalar>
[[nodiscard]] constexpr int lanes_for(int axes) noexcept {
  return axes == 3 && (std::same_as<Scalar, float> || std::same_as<Scalar, double>) ? 4 : axes;
}

/// Axes side by side, one a lane. Neither the number of lanes nor their alignment depends on compiler flags, so that
/// translation units compiled for different processors share one layout.
template <int Axes, Real Scalar>
using Lanes = Eigen::Array<Scalar, lanes_for<Scalar>(Axes), 1, Eigen::DontAlign>;

/// The axes of `values`, with idle lanes, if any, holding `idle`.
template <int Axes, Real Scalar, typename Derived>
[[nodiscard]] Lanes<Axes, Scalar> to_lanes(const Eigen::ArrayBase<Derived>& values, const Scalar& idle) noexcept {
  if constexpr (lanes_for<Scalar>(Axes) == Axes) {
    return values;
  } else {
    using Register [[gnu::vector_size(4 * sizeof(Scalar))]] = Scalar;  // joined there: through memory it would stall
    const Register joined{values.derived()[0], values.derived()[1], values.derived()[2], idle};
    Lanes<Axes, Scalar> lanes;
    std::memcpy(lanes.data(), &joined, sizeof joined);
    return lanes;
  }
}

}  // namespace limpid
