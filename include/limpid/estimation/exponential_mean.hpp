// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/inverse_factorial.hpp>
#include <limpid/core/real.hpp>
#include <limpid/estimation/any_above.hpp>

#include <Eigen/Core>

#include <cstddef>

namespace limpid {
namespace detail {

inline constexpr double short_argument = 1.0 / 16;  // up to here the series serves

// Terms of sum x^n / (n + 1)! until the first one left out is below half a rounding at x = 1/16.
template <Real Scalar>
[[nodiscard]] constexpr std::size_t exponential_mean_terms() noexcept {
  double term = 1, half_rounding = 0.5;
  for (int bit = 0; bit < std::numeric_limits<Scalar>::digits; ++bit) half_rounding /= 2;
  std::size_t n = 0;
  while (term > half_rounding) term *= short_argument / static_cast<double>(++n + 1);
  return n;
}

// Coefficients first, first + 1, ... of `count` terms, halved until two are left: short chains (Estrin).
template <std::size_t first, std::size_t count, typename Array>
[[nodiscard]] EIGEN_ALWAYS_INLINE Array exponential_mean_terms_from(const Array& x, const Array& x2, const Array& x4,
                                                                    const Array& x8) noexcept {
  using Scalar = typename Array::Scalar;
  if constexpr (count == 1) {
    return Array::Constant(inverse_factorial<Scalar, first + 1>());
  } else if constexpr (count == 2) {
    return inverse_factorial<Scalar, first + 1>() + x * inverse_factorial<Scalar, first + 2>();
  } else {
    constexpr std::size_t half = count > 8 ? 8 : count > 4 ? 4 : 2;
    const Array& power = half == 8 ? x8 : half == 4 ? x4 : x2;
    return exponential_mean_terms_from<first, half>(x, x2, x4, x8) +
           power * exponential_mean_terms_from<first + half, count - half>(x, x2, x4, x8);
  }
}

}  // namespace detail

/// (exp(x) - 1) / x, the mean of exp over [0, x], for |x| <= 1/16; entry by entry, to a few roundings.
/// @realtime  no allocation, no throw, no branch; 9 terms in double
template <typename Array>
[[nodiscard]] EIGEN_ALWAYS_INLINE Array short_exponential_mean(const Array& x) noexcept {
  const Array x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
  return detail::exponential_mean_terms_from<0, detail::exponential_mean_terms<typename Array::Scalar>()>(x, x2, x4,
                                                                                                          x8);
}

/// (exp(x) - 1) / x, the mean of exp over [0, x], and 1 at x = 0; entry by entry, to a few roundings.
/// @realtime  no allocation, no throw; a polynomial where all |x| <= 1/16, libm beyond
template <typename Array>
[[nodiscard]] Array exponential_mean(const Array& x) noexcept {
  using Scalar = typename Array::Scalar;
  using std::expm1;
  if (!any_above(Array(x.abs()), Scalar(detail::short_argument))) [[likely]]
    return short_exponential_mean(x);
  return x.unaryExpr([](const Scalar& a) { return a == Scalar{0} ? Scalar{1} : Scalar(expm1(a) / a); });
}

}  // namespace limpid
