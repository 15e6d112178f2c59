// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/lane_exponential.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace limpid {

namespace detail {

/// The leading 26 bits: products of two such are exact.
template <int n>
[[gnu::always_inline]] inline void head_of(const typename Doubles<n>::Value& value,
                                           typename Doubles<n>::Value& head) noexcept {
  typename Words<n>::Value bits;
  copy_bits(value, bits);
  bits &= ~std::uint64_t{0x7ff'ffff};
  copy_bits(bits, head);
}

/// ln x as its leading 26 bits and the rest, to 2^-58 of it. The quotient s = (m - 1)/(m + 1) is found in two parts;
/// what the series adds to 2 s is 1/100 of it at most, and one double. That comes last, and is the last to be added.
template <int n>
[[gnu::always_inline]] inline void long_logarithm(const typename Doubles<n>::Value& x, typename Doubles<n>::Value& head,
                                                  typename Doubles<n>::Value& rest) noexcept {
  using Value = typename Doubles<n>::Value;
  Value k, m, s_head, below_head, p;
  split<n>(x, k, m);
  const Value above = m - 1.0, below = m + 1.0, below_lost = m - (below - 1.0);
  const Value s = above / below, inverse = 1.0 / below, z = s * s;
  paired_polynomial<Value>(ExponentialPolynomials<double>::logarithm, z, p);
  head_of<n>(s, s_head);
  head_of<n>(below, below_head);
  const Value s_tail = ((above - s_head * below_head) - s_head * ((below - below_head) + below_lost)) * inverse;
  const Value turns = k * ln2_head, twice = 2.0 * s_head, most = turns + twice, most_lost = twice - (most - turns);
  head_of<n>(most, head);
  rest = ((most - head) + (most_lost + (2.0 * s_tail + k * ln2_tail))) + s * z * p;
}

/// Largest |p ln x| and |p| for which x^p is found in lanes: the error grows with the first; beyond the second the rest
/// of the logarithm would reach another power of two.
inline constexpr double largest_power = 40, largest_exponent_of_power = 16;

/// x^p for x > 0, e^y with y = p ln x in two parts, of which the powers of two know the first.
template <typename Scalar, int n>
[[gnu::always_inline]] inline void power(const typename Doubles<n>::Value& x, const typename Doubles<n>::Value& p,
                                         typename Doubles<n>::Value& y, typename Doubles<n>::Value& result) noexcept {
  using Value = typename Doubles<n>::Value;
  Value k;
  if constexpr (std::same_as<Scalar, float>) {
    Value m, ln;
    split<n>(x, k, m);
    logarithm<Scalar, n>(k, m - 1.0, ln);
    y = p * ln;
    exponential<Scalar, n>(y, result);
  } else {
    Value ln, ln_rest, p_head, shifted;
    long_logarithm<n>(x, ln, ln_rest);
    head_of<n>(p, p_head);
    y = p_head * ln;
    whole_powers<n>(y, shifted, k);
    const Value near = ((y - k * ln2_head) - k * ln2_tail) + (p - p_head) * ln;
    scaled_exponential<Scalar, n>(shifted, near + p * ln_rest, result);
  }
}

template <typename Scalar>
struct Pow {
  Scalar operator()(const Scalar& x, const Scalar& p) const noexcept {
    using std::pow;
    return pow(x, p);
  }
};

}  // namespace detail

/// x^p of each entry, x >= 0. Two to four entries of float or double go side by side, three in four lanes, where
/// |p ln x| <= 40 and |p| <= 16: to 1.4 units in the last place for |p| <= 2 and x from 1e-7 on, else to 4. So does
/// zero with p >= 0 (0^0 = 1). Others by the scalar's own function. Of three depths in 19 ns to 1e-16; libm in 55 to
/// 6e-17, exp(p ln x) no faster (bench/time_error).
/// @realtime  no allocation, no throw; two divisions and some 80 flops an entry
template <typename Array>
[[nodiscard]] Array power(const Array& x, const std::type_identity_t<Array>& p) noexcept {
  using Scalar = typename Array::Scalar;
  if constexpr (detail::beside<Array>) {
    constexpr int n = detail::lanes_of<Array>;
    using Value = detail::LanesOf<Array>;
    Value at, by, y, result;
    detail::load_lanes<Array>(at, x);
    detail::load_lanes<Array>(by, p);
    detail::power<Scalar, n>(at, by, y, result);
    const auto zero = (at == 0.0) & (by >= 0.0);
    const auto usual = (at >= std::numeric_limits<double>::min()) & (at <= std::numeric_limits<double>::max()) &
                       (y <= detail::largest_power) & (y >= -detail::largest_power) &
                       (by <= detail::largest_exponent_of_power) & (by >= -detail::largest_exponent_of_power);
    if (detail::all_lanes<n>(zero | usual)) [[likely]] {
      const Value of_zero = by == 0.0 ? Value{} + 1.0 : Value{};
      return detail::from_lanes<Array>(Value(zero ? of_zero : result));
    }
    return detail::each_alone<Array>(detail::Pow<Scalar>{}, x, p);
  } else {
    return detail::entry_by_entry<Array>(detail::Pow<Scalar>{}, x, p);
  }
}

/// With the same p for all.
template <typename Array>
[[nodiscard]] Array power(const Array& x, const typename Array::Scalar& p) noexcept {
  return power(x, Array::Constant(p).eval());
}

}  // namespace limpid
