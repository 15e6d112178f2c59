// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/core/unroll.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

/// Numbers side by side, each lane for itself.
namespace limpid::detail {

/// `width` numbers side by side, in registers of the target's width; the layout is the same for every target.
template <Real Scalar, int width>
struct alignas(width * sizeof(Scalar)) Pack {
#if defined(__AVX__)
  static constexpr std::size_t most_bytes = 32;
#else
  static constexpr std::size_t most_bytes = 16;
#endif
  static constexpr std::size_t bytes = std::min(width * sizeof(Scalar), most_bytes);
  static constexpr int registers = static_cast<int>(width * sizeof(Scalar) / bytes);
  static constexpr int lanes = width / registers;
  using Register [[gnu::vector_size(bytes)]] = Scalar;

  Register parts[registers];  // NOLINT(*-avoid-c-arrays): an aggregate of registers

  [[nodiscard]] static EIGEN_ALWAYS_INLINE Pack constant(const Scalar& value) {
    Pack result;
    for (auto& part : result.parts) part = Register{} + value;
    return result;
  }
  [[nodiscard]] EIGEN_ALWAYS_INLINE Scalar operator[](int i) const { return parts[i / lanes][i % lanes]; }
  EIGEN_ALWAYS_INLINE void set(int i, const Scalar& value) { parts[i / lanes][i % lanes] = value; }

  [[nodiscard]] friend EIGEN_ALWAYS_INLINE Pack operator+(const Pack& a, const Pack& b) { return Pack(a) += b; }
  [[nodiscard]] friend EIGEN_ALWAYS_INLINE Pack operator-(const Pack& a, const Pack& b) { return Pack(a) -= b; }
  [[nodiscard]] friend EIGEN_ALWAYS_INLINE Pack operator-(const Pack& a) { return Pack{} -= a; }
  [[nodiscard]] friend EIGEN_ALWAYS_INLINE Pack operator*(const Pack& a, const Pack& b) {
    Pack result;
    for (int i = 0; i < registers; ++i) result.parts[i] = a.parts[i] * b.parts[i];
    return result;
  }
  [[nodiscard]] friend EIGEN_ALWAYS_INLINE Pack operator*(const Pack& a, const Scalar& b) {
    Pack result;
    for (int i = 0; i < registers; ++i) result.parts[i] = a.parts[i] * b;
    return result;
  }
  [[nodiscard]] friend EIGEN_ALWAYS_INLINE Pack operator/(const Pack& a, const Pack& b) {
    Pack result;
    for (int i = 0; i < registers; ++i) result.parts[i] = a.parts[i] / b.parts[i];
    return result;
  }
  EIGEN_ALWAYS_INLINE Pack& operator+=(const Pack& b) {
    for (int i = 0; i < registers; ++i) parts[i] += b.parts[i];
    return *this;
  }
  EIGEN_ALWAYS_INLINE Pack& operator-=(const Pack& b) {
    for (int i = 0; i < registers; ++i) parts[i] -= b.parts[i];
    return *this;
  }
};

/// One entry of `width` matrices side by side, or of one.
template <Real Scalar, int width>
using Entry = std::conditional_t<width == 1, Scalar, Pack<Scalar, width == 1 ? 2 : width>>;

/// Whether several fill a register.
template <Real Scalar>
inline constexpr bool fills_lanes = std::same_as<Scalar, double> || std::same_as<Scalar, float>;

template <typename E>
struct LaneTraits {
  using Scalar = E;
  static constexpr int width = 1;
};
template <typename E>
requires requires(E e) { e[0] + e[0]; }
struct LaneTraits<E> {
  using Scalar = std::remove_cvref_t<decltype(std::declval<E&>()[0])>;
  static constexpr int width = static_cast<int>(sizeof(E) / sizeof(Scalar));
};
template <typename E>
using LaneScalar = typename LaneTraits<E>::Scalar;

template <typename E>
[[nodiscard]] EIGEN_ALWAYS_INLINE E all_lanes(const LaneScalar<E>& value) {
  if constexpr (LaneTraits<E>::width == 1) {
    return value;
  } else {
    return E::constant(value);
  }
}
template <typename E>
EIGEN_ALWAYS_INLINE void set_all_lanes(E& entry, const LaneScalar<E>& value) {
  entry = all_lanes<E>(value);
}
template <typename E>
[[nodiscard]] EIGEN_ALWAYS_INLINE LaneScalar<E> lane(const E& value, int i) {
  if constexpr (LaneTraits<E>::width == 1) {
    return value;
  } else {
    return value[i];
  }
}
template <typename E>
EIGEN_ALWAYS_INLINE void set_lane(E& value, int i, const LaneScalar<E>& to) {
  if constexpr (LaneTraits<E>::width == 1) {
    value = to;
  } else {
    value.set(i, to);
  }
}
template <typename E>
[[nodiscard]] EIGEN_ALWAYS_INLINE LaneScalar<E> sum_of_lanes(const E& value) {
  LaneScalar<E> sum = lane(value, 0);
  for (int i = 1; i < LaneTraits<E>::width; ++i) sum += lane(value, i);
  return sum;
}
template <typename E>
[[nodiscard]] EIGEN_ALWAYS_INLINE bool all_positive(const E& value) {  // false for NaN
  bool positive = true;
  for (int i = 0; i < LaneTraits<E>::width; ++i) positive = positive && lane(value, i) > LaneScalar<E>{0};
  return positive;
}

}  // namespace limpid::detail
