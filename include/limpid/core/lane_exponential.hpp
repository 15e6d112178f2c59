// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/lane_math.hpp>
#include <limpid/core/lanes.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace limpid {

namespace detail {

/// Polynomials of least largest error, relative to the function (exchange algorithm of Remez, in 60 digits):
/// (e^r - 1 - r)/r^2 in powers of r, and (ln((1 + s)/(1 - s)) - 2 s)/s^3 in powers of s^2, for arguments of the
/// logarithm from 1/sqrt(2) to sqrt(2) and, `near_logarithm`, from 1/2 to 2. In double to 3.6e-19 for |r| <= 0.402
/// (`power` asks for more than ln(2)/2), 1.2e-18 and 3.5e-20, for float to 5.2e-11 for |r| <= ln(2)/2, 4.8e-12 and
/// 2.7e-12.
template <std::floating_point Scalar>
struct ExponentialPolynomials {
  static constexpr std::array exponential{0.50000000000000002595,   0.16666666666666739859,   0.041666666666664151197,
                                          0.0083333333332802668923, 0.0013888888889629787105, 1.9841269974931794624e-4,
                                          2.4801586390556123249e-5, 2.7557166884096687706e-6, 2.7557793657237950436e-7,
                                          2.5132659128451754866e-8, 2.0809463616050544001e-9};
  static constexpr std::array logarithm{0.66666666666667342033, 0.39999999999416016865, 0.28571428742102215264,
                                        0.22222198601143705911, 0.18183562942596935935, 0.15314084196169767537,
                                        0.14795630150678134061};
  static constexpr std::array near_logarithm{0.6666666666666667814,   0.39999999999994055435, 0.28571428572498323215,
                                             0.2222222212634255669,   0.18181823165601585946, 0.15384452919778423689,
                                             0.13336789115694149886,  0.1171613157038739271,  0.10971352838713930728,
                                             0.069988438695455377371, 0.16460126362515060466};
};
template <>
struct ExponentialPolynomials<float> {
  static constexpr std::array exponential{0.50000000676820677523,   0.16666665868934006696,   0.04166629494738628668,
                                          0.0083334970752040808993, 0.0013944659620643855921, 1.9790341314404201801e-4};
  static constexpr std::array logarithm{0.66666665648232434806, 0.4000033463690630921, 0.2853733996545665897,
                                        0.23581613733544552263};
  static constexpr std::array near_logarithm{0.66666666363365617081, 0.40000052464500066267, 0.28568418116563004493,
                                             0.22301104918887868251, 0.17151071024033478795, 0.21782633255655734576};
};

/// The bits of `n` doubles.
template <int n>
struct Words {
  using Value [[gnu::vector_size(n * sizeof(double))]] = std::uint64_t;
};

template <typename From, typename To>
[[gnu::always_inline]] inline void copy_bits(const From& from, To& to) noexcept {
  static_assert(sizeof from == sizeof to);
  std::memcpy(&to, &from, sizeof to);
}

/// Whether a comparison holds in all lanes.
template <int n, typename Mask>
[[gnu::always_inline]] inline bool all_lanes(const Mask& mask) noexcept {
  if constexpr (n == 2) {
    return (mask[0] & mask[1]) != 0;
  } else {
    return ((mask[0] & mask[1]) & (mask[2] & mask[3])) != 0;
  }
}

/// Coefficients in powers of z, in pairs, pairs of pairs and so on (Estrin): a short chain for one result at a time.
template <typename Value, std::size_t first, std::size_t terms, std::size_t count>
[[gnu::always_inline]] inline void paired(const std::array<double, count>& c, const auto& powers, Value& sum) noexcept {
  if constexpr (terms == 1) {
    sum = Value{} + c[first];
  } else if constexpr (terms == 2) {
    sum = c[first] + c[first + 1] * powers[0];
  } else {
    constexpr std::size_t level = std::bit_width(terms - 1) - 1, lower = std::size_t{1} << level;
    Value high;
    paired<Value, first, lower>(c, powers, sum);
    paired<Value, first + lower, terms - lower>(c, powers, high);
    sum += high * powers[level];
  }
}

template <typename Value, std::size_t count>
[[gnu::always_inline]] inline void paired_polynomial(const std::array<double, count>& c, const Value& z,
                                                     Value& sum) noexcept {
  constexpr std::size_t levels = std::bit_width(count - 1);
  std::array<Value, levels> powers;  // z, z^2, z^4, ...
  powers[0] = z;
  for (std::size_t i = 1; i < levels; ++i) powers[i] = powers[i - 1] * powers[i - 1];
  paired<Value, 0, count>(c, powers, sum);
}

// ln 2, of 42 bits, of which a multiple below 2048 is exact, and what is left.
inline constexpr double ln2_head = 0x1.62e42fefa38p-1, ln2_tail = 0x1.ef35793c7673p-45;

/// Largest |x| for which e^x is not near the least or the largest number.
inline constexpr double largest_exponent = 707;

/// k = y / ln 2, rounded to whole numbers; they stand in the last bits of `shifted`.
template <int n>
[[gnu::always_inline]] inline void whole_powers(const typename Doubles<n>::Value& y,
                                                typename Doubles<n>::Value& shifted,
                                                typename Doubles<n>::Value& k) noexcept {
  constexpr double shift = 0x1.8p52;
  shifted = y * 1.4426950408889634074 + shift;
  k = shifted - shift;
}

/// 2^k e^r.
template <typename Scalar, int n>
[[gnu::always_inline]] inline void scaled_exponential(const typename Doubles<n>::Value& shifted,
                                                      const typename Doubles<n>::Value& r,
                                                      typename Doubles<n>::Value& result) noexcept {
  using Value = typename Doubles<n>::Value;
  Value q;
  paired_polynomial<Value>(ExponentialPolynomials<Scalar>::exponential, r, q);
  const Value near = 1.0 + (r + r * r * q);
  typename Words<n>::Value bits, k;
  copy_bits(near, bits);
  copy_bits(shifted, k);
  bits += k << 52;
  copy_bits(bits, result);
}

/// e^x for |x| <= largest_exponent.
template <typename Scalar, int n>
[[gnu::always_inline]] inline void exponential(const typename Doubles<n>::Value& x,
                                               typename Doubles<n>::Value& result) noexcept {
  using Value = typename Doubles<n>::Value;
  Value shifted, k;
  whole_powers<n>(x, shifted, k);
  scaled_exponential<Scalar, n>(shifted, (x - k * ln2_head) - k * ln2_tail, result);
}

/// x = 2^k m, m from 1/sqrt(2) to sqrt(2), for positive normal x.
template <int n>
[[gnu::always_inline]] inline void split(const typename Doubles<n>::Value& x, typename Doubles<n>::Value& k,
                                         typename Doubles<n>::Value& m) noexcept {
  constexpr std::uint64_t one = 0x3ff0'0000'0000'0000, root = 0x3fe6'a09e'667f'3bcd, fraction = 0xf'ffff'ffff'ffff,
                          whole = 0x4330'0000'0000'0000;  // bits of 1, of 1/sqrt(2) and of 2^52
  typename Words<n>::Value bits;
  copy_bits(x, bits);
  bits += one - root;
  const typename Words<n>::Value exponent = (bits >> 52) | whole, mantissa = (bits & fraction) + root;
  copy_bits(exponent, k);
  copy_bits(mantissa, m);
  k -= 0x1p52 + 1023;
}

/// k ln 2 + ln(1 + f), 1 + f from 1/sqrt(2) to sqrt(2): of 2 s + s R, s = f/(2 + f), what is not f is summed apart.
template <typename Scalar, int n>
[[gnu::always_inline]] inline void logarithm(const typename Doubles<n>::Value& k, const typename Doubles<n>::Value& f,
                                             typename Doubles<n>::Value& result) noexcept {
  using Value = typename Doubles<n>::Value;
  const Value s = f / (2.0 + f), z = s * s, half = 0.5 * f * f;
  Value p;
  paired_polynomial<Value>(ExponentialPolynomials<Scalar>::logarithm, z, p);
  result = k * ln2_head - ((half - (s * (half + z * p) + k * ln2_tail)) - f);
}

/// ln(1 + x) for x from -1/2 to 1, where |s| <= 1/3 needs no powers of two taken off.
template <typename Scalar, int n>
[[gnu::always_inline]] inline void near_logarithm(const typename Doubles<n>::Value& x,
                                                  typename Doubles<n>::Value& result) noexcept {
  using Value = typename Doubles<n>::Value;
  const Value s = x / (2.0 + x), z = s * s, half = 0.5 * x * x;
  Value p;
  paired_polynomial<Value>(ExponentialPolynomials<Scalar>::near_logarithm, z, p);
  result = x - (half - s * (half + z * p));
}

/// Whether the entries of an Array are taken side by side, three of them in four lanes. For one alone libm's tables are
/// as fast, and nearer (bench/time_error).
template <typename Array>
inline constexpr bool beside =
    Array::SizeAtCompileTime > 1 && in_lanes<Lanes<Array::SizeAtCompileTime, typename Array::Scalar>>;

template <typename Array>
inline constexpr int lanes_of = lanes_for<typename Array::Scalar>(Array::SizeAtCompileTime);

template <typename Array>
using LanesOf = typename Doubles<lanes_of<Array>>::Value;

template <typename Array>
[[gnu::always_inline]] inline void load_lanes(LanesOf<Array>& value, const Array& array) noexcept {
  load(value, to_lanes<Array::SizeAtCompileTime>(array));
}

template <typename Array>
[[gnu::always_inline]] inline Array from_lanes(const LanesOf<Array>& value) noexcept {
  using All = Lanes<Array::SizeAtCompileTime, typename Array::Scalar>;
  return stored<All>(value).template head<Array::SizeAtCompileTime>();
}

template <typename Array, typename Function, typename... Arrays>
Array entry_by_entry(Function function, const Arrays&... of) noexcept {
  Array result;
  for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = function(of[i]...);
  return result;
}

/// Of lanes, which that is rare for: apart, so that callers stay small.
template <typename Array, typename Function, typename... Arrays>
[[gnu::noinline]] Array each_alone(Function function, const Arrays&... of) noexcept {
  return entry_by_entry<Array>(function, of...);
}

template <typename Scalar>
struct Exp {
  Scalar operator()(const Scalar& x) const noexcept {
    using std::exp;
    return exp(x);
  }
};
template <typename Scalar>
struct Log {
  Scalar operator()(const Scalar& x) const noexcept {
    using std::log;
    return log(x);
  }
};
template <typename Scalar>
struct Log1p {
  Scalar operator()(const Scalar& x) const noexcept {
    using std::log1p;
    return log1p(x);
  }
};

}  // namespace detail

/// e^x of each entry. Two to four entries of float or double go side by side, three in four lanes, to 1.1 units in the
/// last place for |x| <= 707; others, and larger ones, by the scalar's own function. Of three in 8 ns to 9e-17; libm in
/// 22 to 6e-17 (bench/time_error).
/// @realtime  no allocation, no throw; some 25 flops an entry
template <typename Array>
[[nodiscard]] Array exponential(const Array& x) noexcept {
  using Scalar = typename Array::Scalar;
  if constexpr (detail::beside<Array>) {
    constexpr int n = detail::lanes_of<Array>;
    detail::LanesOf<Array> at, result;
    detail::load_lanes<Array>(at, x);
    if (detail::all_lanes<n>((at <= detail::largest_exponent) & (at >= -detail::largest_exponent))) [[likely]] {
      detail::exponential<Scalar, n>(at, result);
      return detail::from_lanes<Array>(result);
    }
    return detail::each_alone<Array>(detail::Exp<Scalar>{}, x);
  } else {
    return detail::entry_by_entry<Array>(detail::Exp<Scalar>{}, x);
  }
}

/// ln x of each entry. As above: side by side to 0.85 units in the last place for positive normal numbers.
/// @realtime  no allocation, no throw; one division and some 30 flops an entry
template <typename Array>
[[nodiscard]] Array logarithm(const Array& x) noexcept {
  using Scalar = typename Array::Scalar;
  if constexpr (detail::beside<Array>) {
    constexpr int n = detail::lanes_of<Array>;
    detail::LanesOf<Array> at, k, m, result;
    detail::load_lanes<Array>(at, x);
    if (detail::all_lanes<n>((at >= std::numeric_limits<double>::min()) & (at <= std::numeric_limits<double>::max())))
        [[likely]] {
      detail::split<n>(at, k, m);
      detail::logarithm<Scalar, n>(k, m - 1.0, result);
      return detail::from_lanes<Array>(result);
    }
    return detail::each_alone<Array>(detail::Log<Scalar>{}, x);
  } else {
    return detail::entry_by_entry<Array>(detail::Log<Scalar>{}, x);
  }
}

/// ln(1 + x) of each entry. As above: side by side to 1.4 units in the last place for x from -1/2 to 1. Of three in 8
/// ns to 1.3e-16; libm in 28 to 1e-16.
/// @realtime  no allocation, no throw; one division and some 30 flops an entry
template <typename Array>
[[nodiscard]] Array logarithm_of_one_plus(const Array& x) noexcept {
  using Scalar = typename Array::Scalar;
  if constexpr (detail::beside<Array>) {
    constexpr int n = detail::lanes_of<Array>;
    detail::LanesOf<Array> at, result;
    detail::load_lanes<Array>(at, x);
    if (detail::all_lanes<n>((at >= -0.5) & (at <= 1.0))) [[likely]] {
      detail::near_logarithm<Scalar, n>(at, result);
      return detail::from_lanes<Array>(result);
    }
    return detail::each_alone<Array>(detail::Log1p<Scalar>{}, x);
  } else {
    return detail::entry_by_entry<Array>(detail::Log1p<Scalar>{}, x);
  }
}

}  // namespace limpid
