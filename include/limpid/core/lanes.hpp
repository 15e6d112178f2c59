// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <utility>

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

/// The same of each column, an array of lanes a column.
template <int Axes, typename Derived>
[[nodiscard]] EIGEN_ALWAYS_INLINE auto to_lane_columns(const Eigen::ArrayBase<Derived>& values) noexcept {
  constexpr int columns = Derived::ColsAtCompileTime;
  using Scalar = typename Derived::Scalar;
  std::array<Lanes<Axes, Scalar>, std::size_t{columns}> lanes;
  for (int j = 0; j < columns; ++j) {
    auto& column = lanes[static_cast<std::size_t>(j)];
    const auto& v = values.derived().col(j);
    if constexpr (lanes_for<Scalar>(Axes) == Axes) {
      column = v;
    } else {
      using Pair [[gnu::vector_size(2 * sizeof(Scalar))]] = Scalar;  // as columns are stored: another cut would stall
      using Register [[gnu::vector_size(4 * sizeof(Scalar))]] = Scalar;
      Pair pair;
      std::memcpy(&pair, v.data(), sizeof pair);
      const Register joined{pair[0], pair[1], v[2], v[2]};
      std::memcpy(column.data(), &joined, sizeof joined);
    }
  }
  return lanes;
}

/// How many lanes hold `size` parameters: of float and double whole packets, those beyond them zero.
template <Real Scalar>
[[nodiscard]] constexpr int packed_lanes_for(int size) noexcept {
  return std::same_as<Scalar, float> || std::same_as<Scalar, double> ? (size + 3) / 4 * 4 : size;
}

/// Parameters side by side, in whole packets.
template <int Size, Real Scalar>
using PackedLanes = Eigen::Array<Scalar, packed_lanes_for<Scalar>(Size), 1, Eigen::DontAlign>;

/// A column in whole packets, zero beyond its end.
template <typename Derived>
[[nodiscard]] EIGEN_ALWAYS_INLINE auto to_packed_lanes(const Eigen::DenseBase<Derived>& values) noexcept {
  using Scalar = typename Derived::Scalar;
  constexpr int size = Derived::SizeAtCompileTime;
  PackedLanes<size, Scalar> lanes;
  const auto& v = values.derived();
  if constexpr (packed_lanes_for<Scalar>(size) == 4 * ((size + 3) / 4) && std::floating_point<Scalar> &&
                sizeof(Scalar) <= sizeof(double)) {
    using Register [[gnu::vector_size(4 * sizeof(Scalar))]] = Scalar;  // joined there: through memory it would stall
    const auto entry = [&](int i) { return i < size ? Scalar(v[i]) : Scalar{0}; };
    [&]<int... packet>(std::integer_sequence<int, packet...>) {
      const auto join = [&](int i) __attribute__((always_inline)) {
        const Register joined{entry(i), entry(i + 1), entry(i + 2), entry(i + 3)};
        std::memcpy(lanes.data() + i, &joined, sizeof joined);
      };
      (join(4 * packet), ...);
    }
    (std::make_integer_sequence<int, (size + 3) / 4>{});
  } else {
    lanes = v.array();
  }
  return lanes;
}

/// The axes of lanes.
template <int Axes, typename Derived>
[[nodiscard]] Eigen::Array<typename Derived::Scalar, Axes, 1> from_lanes(
    const Eigen::ArrayBase<Derived>& lanes) noexcept {
  return lanes.template head<Axes>();
}

}  // namespace limpid
