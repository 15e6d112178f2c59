// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/any_lane.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace limpid {

/// Sines and cosines, entry by entry.
template <typename Array>
struct SineCosine {
  Array sine, cosine;
};

namespace detail {

/// Polynomials of least largest error, relative to the function (exchange algorithm of Remez, in 60 digits): on
/// [-pi/4, pi/4] and, of the arc tangent, up to tan(pi/8). In double to 3.4e-18, 4.7e-20 and 1.2e-18, for float to
/// 4.9e-12, 9.9e-14 and 6.6e-10.
template <std::floating_point Scalar>
struct TrigonometricPolynomials {  // (sin x - x)/x^3, (cos x - 1 + x^2/2)/x^4, (atan x - x)/x^3, in powers of x^2
  static constexpr std::array sine{-0.1666666666666663205,   0.0083333333333224195029,  -0.00019841269829812625853,
                                   2.7557313693640900423e-6, -2.5050758393329111074e-8, 1.5896812247586798413e-10};
  static constexpr std::array cosine{0.041666666666666599526,   -0.0013888888888874132605, 0.000024801587289487661646,
                                     -2.7557314353939799499e-7, 2.0875723495691226403e-9,  -1.1359659551353221971e-11};
  static constexpr std::array arc_tangent{-0.33333333333333199012,  0.19999999999954048101,   -0.14285714280244686412,
                                          0.11111110785931512573,   -0.090908978301592196848, 0.07692061519802098074,
                                          -0.066631189960323598122, 0.058479984630972247397,  -0.050397969575128943842,
                                          0.03807705339224607537,   -0.017920856676370416742};
};
template <>
struct TrigonometricPolynomials<float> {
  static constexpr std::array sine{-0.16666666641617740884, 0.0083333293847956737448, -0.00019839334471740176587,
                                   2.7183079448803111917e-6};
  static constexpr std::array cosine{0.041666666622812236159, -0.001388888375200754295, 0.000024799519629448142524,
                                     -2.7210205737895614076e-7};
  static constexpr std::array arc_tangent{-0.33333315496688936324, 0.19998488860764792613, -0.14243837091159771901,
                                          0.10595910470424547307, -0.060832111613260860454};
};

/// `n` doubles as the compiler's vector type; one is a plain double.
template <int n>
struct Doubles {
  using Value [[gnu::vector_size(n * sizeof(double))]] = double;
  using Bits [[gnu::vector_size(n * sizeof(double))]] = std::int64_t;
};
template <>
struct Doubles<1> {
  using Value = double;
  using Bits = std::int64_t;
};

/// Whether the compiler may hold four doubles in one register. Where not it takes choices between them one by one: then
/// they go in two halves.
#ifdef __AVX__
inline constexpr bool four_in_a_register = true;
#else
inline constexpr bool four_in_a_register = false;
#endif
template <int n>
inline constexpr bool in_halves = n == 4 && !four_in_a_register;
using Halves = std::array<Doubles<2>::Value, 2>;

/// Coefficients in powers of z, in two halves that the processor takes at once. Vectors go by reference: by value their
/// ABI would depend on the processor.
template <typename Value, std::size_t count>
[[gnu::always_inline]] inline void polynomial(const std::array<double, count>& c, const Value& z, Value& sum) noexcept {
  constexpr std::size_t even = (count - 1) / 2 * 2, odd = count / 2 * 2 - 1;  // the highest powers
  const Value zz = z * z;
  Value rest = Value{} + c[odd];
  sum = Value{} + c[even];
#pragma GCC unroll 8
  for (std::size_t i = even; i >= 2; i -= 2) sum = sum * zz + c[i - 2];
#pragma GCC unroll 8
  for (std::size_t i = odd; i >= 3; i -= 2) rest = rest * zz + c[i - 2];
  sum += rest * z;
}

/// Largest |angle| for which the quarter turns taken off, times the leading parts of pi/2, are exact.
inline constexpr double largest_reduced_angle = 1e5;

template <typename Scalar, int n>
[[gnu::always_inline]] inline void sine_cosine(const typename Doubles<n>::Value& angle,
                                               typename Doubles<n>::Value& sine,
                                               typename Doubles<n>::Value& cosine) noexcept {
  using Value = typename Doubles<n>::Value;
  using Bits = typename Doubles<n>::Bits;
  using Polynomials = TrigonometricPolynomials<Scalar>;
  if constexpr (in_halves<n>) {
    Halves at, s, c;
    std::memcpy(&at, &angle, sizeof at);
    for (std::size_t i = 0; i < at.size(); ++i) sine_cosine<Scalar, 2>(at[i], s[i], c[i]);
    std::memcpy(&sine, &s, sizeof sine);
    std::memcpy(&cosine, &c, sizeof cosine);
    return;
  }
  constexpr double shift = 0x1.8p52;  // a sum with it is rounded to whole numbers, whose last bits are the double's
  const Value shifted = angle * 0.63661977236758134308 + shift, quarters = shifted - shift;
  Bits quarter;
  std::memcpy(&quarter, &shifted, sizeof quarter);
  // Less quarters pi/2, in parts of 33, 33 and 53 bits; what the last difference rounds away is kept.
  const Value near = (angle - quarters * 0x1.921fb544p+0) - quarters * 0x1.0b4611a6p-34;
  const Value last = quarters * 0x1.3198a2e037073p-69, x = near - last, rest = (near - x) - last;
  const Value z = x * x, half = z * 0.5, most = 1.0 - half;
  Value p, q;
  polynomial<Value>(Polynomials::sine, z, p);
  polynomial<Value>(Polynomials::cosine, z, q);
  const Value s = x + (rest * most + x * z * p);
  const Value c = most + (((1.0 - most) - half) + (z * z * q - x * rest));
  const auto odd = (quarter & 1) != 0;
  const Value sine_of = odd ? c : s, cosine_of = odd ? s : c;
  sine = (quarter & 2) != 0 ? -sine_of : sine_of;
  cosine = ((quarter + 1) & 2) != 0 ? -cosine_of : cosine_of;
}

template <typename Scalar, int n>
[[gnu::always_inline]] inline void arc_tangent(const typename Doubles<n>::Value& y, const typename Doubles<n>::Value& x,
                                               typename Doubles<n>::Value& angle) noexcept {
  using Value = typename Doubles<n>::Value;
  if constexpr (in_halves<n>) {
    Halves up, along_x, result;
    std::memcpy(&up, &y, sizeof up);
    std::memcpy(&along_x, &x, sizeof along_x);
    for (std::size_t i = 0; i < up.size(); ++i) arc_tangent<Scalar, 2>(up[i], along_x[i], result[i]);
    std::memcpy(&angle, &result, sizeof angle);
    return;
  }
  const Value a = y < 0.0 ? -y : y, b = x < 0.0 ? -x : x;
  const auto steep = a > b;
  const Value longer = steep ? a : b, shorter = steep ? b : a;
  // beyond pi/8 the angle to pi/4 is taken
  const auto wide = shorter > 0.41421356237309503 * longer;
  const Value across = wide ? shorter - longer : shorter, along = wide ? shorter + longer : longer;
  const Value t = across / (along == 0.0 ? along + 1.0 : along), z = t * t;
  Value p;
  polynomial<Value>(TrigonometricPolynomials<Scalar>::arc_tangent, z, p);
  const Value r = t + t * z * p;
  constexpr double quarter = 0.78539816339744828, quarter_rest = 3.0616169978683829e-17;  // pi/4
  const Value eighth = wide ? (r + quarter_rest) + quarter : r;
  const Value steeper = steep ? 2 * quarter - (eighth - 2 * quarter_rest) : eighth;
  const Value outer = x < 0.0 ? 4 * quarter - (steeper - 4 * quarter_rest) : steeper;
  angle = y < 0.0 ? -outer : outer;
}

/// Whether the entries of an Array are taken side by side.
template <typename Array>
inline constexpr bool in_lanes = (std::same_as<typename Array::Scalar, float> ||
                                  std::same_as<typename Array::Scalar, double>)&&(Array::SizeAtCompileTime == 1 ||
                                                                                  Array::SizeAtCompileTime == 2 ||
                                                                                  Array::SizeAtCompileTime == 4);

template <typename Array>
[[gnu::always_inline]] inline bool all_reduced(const Array& angle) noexcept {
  using Scalar = typename Array::Scalar;
  if constexpr (in_packets<Array>) {
    return all_at_most(Array(angle.abs()), Scalar(largest_reduced_angle));
  } else {
    return angle.abs().sum() <= Scalar(largest_reduced_angle);
  }
}

template <typename Value, typename Array>
[[gnu::always_inline]] inline void load(Value& value, const Array& array) noexcept {
  if constexpr (std::same_as<typename Array::Scalar, double>) {
    std::memcpy(&value, array.data(), sizeof value);  // in one piece: gathered from several it would stall
  } else {
    const Eigen::Array<double, Array::SizeAtCompileTime, 1, Eigen::DontAlign> doubles = array.template cast<double>();
    std::memcpy(&value, doubles.data(), sizeof value);
  }
}
template <typename Array, typename Value>
[[gnu::always_inline]] inline Array stored(const Value& value) noexcept {
  if constexpr (std::same_as<typename Array::Scalar, double>) {
    Array array;
    std::memcpy(array.data(), &value, sizeof value);
    return array;
  } else {
    Eigen::Array<double, Array::SizeAtCompileTime, 1, Eigen::DontAlign> doubles;
    std::memcpy(doubles.data(), &value, sizeof value);
    return doubles.template cast<typename Array::Scalar>();
  }
}

}  // namespace detail

/// Sine and cosine of each entry, rad. One, two or four entries of float or double go side by side, to 1.5 units in the
/// last place up to 1e5 rad (3 entries: see `to_lanes`); others, and larger ones, by the scalar's own functions. The
/// sine of -0 is 0. Of three angles to 1.1e-16 in less than a third of the time of libm, 6e-17 (bench/time_error).
/// @realtime  no allocation, no throw; some 50 flops an entry
template <typename Array>
[[nodiscard, gnu::always_inline]] inline SineCosine<Array> sine_cosine(const Array& angle) noexcept {
  using Scalar = typename Array::Scalar;
  using std::cos, std::sin;
  if constexpr (detail::in_lanes<Array>) {
    if (detail::all_reduced(angle)) [[likely]] {
      using Value = typename detail::Doubles<Array::SizeAtCompileTime>::Value;
      Value at, sine, cosine;
      detail::load(at, angle);
      detail::sine_cosine<Scalar, Array::SizeAtCompileTime>(at, sine, cosine);
      return {detail::stored<Array>(sine), detail::stored<Array>(cosine)};
    }
  }
  return {angle.unaryExpr([](const Scalar& a) { return Scalar(sin(a)); }),
          angle.unaryExpr([](const Scalar& a) { return Scalar(cos(a)); })};
}

/// Angle of the point (x, y) of each entry, rad, in [-pi, pi]; 0 at the origin. As above: side by side to 2.3 units in
/// the last place, for |x| + |y| below the largest number. A zero has no sign.
/// @realtime  no allocation, no throw; one division and some 40 flops an entry
template <typename Array>
[[nodiscard, gnu::always_inline]] inline Array arc_tangent(const Array& y, const Array& x) noexcept {
  using Scalar = typename Array::Scalar;
  using std::atan2;
  if constexpr (detail::in_lanes<Array>) {
    using Value = typename detail::Doubles<Array::SizeAtCompileTime>::Value;
    Value up, along, angle;
    detail::load(up, y);
    detail::load(along, x);
    detail::arc_tangent<Scalar, Array::SizeAtCompileTime>(up, along, angle);
    return detail::stored<Array>(angle);
  } else {
    return y.binaryExpr(x, [](const Scalar& a, const Scalar& b) { return Scalar(atan2(a, b)); });
  }
}

}  // namespace limpid
