// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/any_lane.hpp>
#include <limpid/core/lanes.hpp>

#include <Eigen/Core>

#include <concepts>
#include <cstring>

namespace limpid::detail {

/// Four float or double in one register, for equations that exchange lanes, which Eigen's arrays do through memory. A
/// class around the compiler's vector, as that by itself would be handed over differently on different processors.
template <std::floating_point Scalar>
struct Quad {
  using Value = typename Packed<Scalar, 4>::Value;
  using Array = Eigen::Array<Scalar, 4, 1, Eigen::DontAlign>;

  Value v;

  /// The same in all lanes.
  [[gnu::always_inline]] static Quad all(const Scalar& s) noexcept { return {Value{s, s, s, s}}; }

  [[gnu::always_inline]] static Quad of(const Array& array) noexcept {
    Quad quad;
    std::memcpy(&quad.v, array.data(), sizeof quad.v);
    return quad;
  }
  /// A vector on x, y, z, with z again: as it is stored in two pieces, as another cut would wait.
  [[gnu::always_inline]] static Quad of(const Eigen::Matrix<Scalar, 3, 1>& vector) noexcept {
    typename Packed<Scalar, 2>::Value pair;
    std::memcpy(&pair, vector.data(), sizeof pair);
    return {Value{pair[0], pair[1], vector[2], vector[2]}};
  }
  /// The first two lanes and another value, stored in the same two pieces.
  [[gnu::always_inline]] void store(const Scalar& third, Eigen::Matrix<Scalar, 3, 1>& vector) const noexcept {
    const typename Packed<Scalar, 2>::Value pair{v[0], v[1]};
    std::memcpy(vector.data(), &pair, sizeof pair);
    vector[2] = third;
  }
  [[nodiscard, gnu::always_inline]] Array array() const noexcept {
    Array array;
    std::memcpy(array.data(), &v, sizeof v);
    return array;
  }

  [[gnu::always_inline]] friend Quad operator+(const Quad& a, const Quad& b) noexcept { return {a.v + b.v}; }
  [[gnu::always_inline]] friend Quad operator-(const Quad& a, const Quad& b) noexcept { return {a.v - b.v}; }
  [[gnu::always_inline]] friend Quad operator*(const Quad& a, const Quad& b) noexcept { return {a.v * b.v}; }
  [[gnu::always_inline]] friend Quad operator/(const Quad& a, const Quad& b) noexcept { return {a.v / b.v}; }
};

/// Lanes by number: 0 to 3 of `a`, 4 to 7 of `b`.
template <int i, int j, int k, int l, typename Scalar>
[[nodiscard, gnu::always_inline]] inline Quad<Scalar> shuffle(const Quad<Scalar>& a, const Quad<Scalar>& b) noexcept {
  return {__builtin_shufflevector(a.v, b.v, i, j, k, l)};
}

/// One lane in all.
template <int lane, typename Scalar>
[[nodiscard, gnu::always_inline]] inline Quad<Scalar> spread(const Quad<Scalar>& a) noexcept {
  return shuffle<lane, lane, lane, lane>(a, a);
}

}  // namespace limpid::detail
