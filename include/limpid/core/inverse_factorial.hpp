// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <concepts>
#include <cstddef>

namespace limpid::detail {

template <Real Scalar>
[[nodiscard]] constexpr Scalar one_over_factorial(std::size_t n) {
  Scalar product{1};
  for (std::size_t k = 2; k <= n; ++k) product *= Scalar(static_cast<double>(k));
  return Scalar{1} / product;
}

/// 1/n!, a constant of the program for built-in scalars.
template <Real Scalar, std::size_t n>
[[nodiscard]] const Scalar& inverse_factorial() noexcept {
  if constexpr (std::floating_point<Scalar>) {
    static constexpr Scalar value = one_over_factorial<Scalar>(n);
    return value;
  } else {
    static const Scalar value = one_over_factorial<Scalar>(n);
    return value;
  }
}

}  // namespace limpid::detail
