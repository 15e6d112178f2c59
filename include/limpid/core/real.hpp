// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/ieee.hpp>

#include <cmath>
#include <concepts>
#include <limits>

namespace limpid {

/// A real scalar: float, double, long double, or a multiprecision type with expression templates off.
///
/// Minimal: field arithmetic, ordering, `std::numeric_limits`, and `isfinite`, `abs`, `sqrt`, `sin`, `cos`,
/// `atan2`, `exp`, `log` found by argument-dependent lookup beside those of `std`.
template <typename T>
concept Real = std::numeric_limits<T>::is_specialized && !std::numeric_limits<T>::is_integer &&
               std::totally_ordered<T> && requires(T a, T b) {
  { a + b } -> std::convertible_to<T>;
  { a - b } -> std::convertible_to<T>;
  { a* b } -> std::convertible_to<T>;
  { a / b } -> std::convertible_to<T>;
};

/// The nearest `Scalar` to a constant written as a double.
/// Constants that are not exact in binary must not enter a multiprecision instantiation through this: write
/// them as a quotient of integers there.
template <Real Scalar>
[[nodiscard]] constexpr Scalar real(double value) noexcept(std::floating_point<Scalar>) {
  return static_cast<Scalar>(value);
}

/// @realtime  no allocation for built-in scalars
template <Real Scalar>
[[nodiscard]] bool is_finite(const Scalar& value) noexcept {
  using std::isfinite;
  return isfinite(value);
}

}  // namespace limpid
