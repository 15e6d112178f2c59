// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/lane_math.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace limpid::bench::simd {

using Lanes = limpid::detail::Doubles<4>::Value;
using Bits = limpid::detail::Doubles<4>::Bits;

[[gnu::always_inline]] inline Lanes all(double value) { return Lanes{value, value, value, value}; }

/// Three axes, the last one twice.
template <typename Vector>
[[gnu::always_inline]] inline Lanes axes(const Vector& v) {
  using Pair [[gnu::vector_size(16)]] = double;
  Pair pair;
  std::memcpy(&pair, v.data(), sizeof pair);
  return Lanes{pair[0], pair[1], v[2], v[2]};
}

/// One lane in all.
template <int lane>
[[gnu::always_inline]] inline Lanes spread(const Lanes& v) {
  return __builtin_shufflevector(v, v, lane, lane, lane, lane);
}

/// Whether a comparison holds in any lane, or any sign bit is set.
[[gnu::always_inline]] inline bool any(const Bits& mask) {
#ifdef __AVX__
  const Lanes signs = (Lanes)mask;
  return __builtin_ia32_vtestzpd256(signs, signs) == 0;
#else
  return (mask[0] | mask[1] | mask[2] | mask[3]) < 0;
#endif
}

template <std::size_t count>
[[gnu::always_inline]] inline Lanes polynomial(const std::array<double, count>& c, const Lanes& z) {
  const Lanes zz = z * z;
  constexpr std::size_t even = (count - 1) / 2 * 2, odd = count / 2 * 2 - 1;
  Lanes sum = all(c[even]), rest = all(c[odd]);
#pragma GCC unroll 8
  for (std::size_t i = even; i >= 2; i -= 2) sum = sum * zz + c[i - 2];
#pragma GCC unroll 8
  for (std::size_t i = odd; i >= 3; i -= 2) rest = rest * zz + c[i - 2];
  return sum + rest * z;
}

// Interpolated at Chebyshev's points: on [-pi/2, pi/2] and, of the arc tangent, up to 0.2, to 5e-17.
inline constexpr std::array sine_terms{-0.16666666666666666,   0.008333333333333316,   -0.00019841269841254966,
                                       2.7557319219160833e-06, -2.505210761669045e-08, 1.6058977292642743e-10,
                                       -7.643969663988074e-13, 2.7314368769379893e-15};
inline constexpr std::array cosine_terms{-0.5,
                                         0.04166666666666634,
                                         -0.0013888888888860694,
                                         2.4801587292441663e-05,
                                         -2.755731776674132e-07,
                                         2.08766308298722e-09,
                                         -1.1464688686901012e-11,
                                         4.6276610380051693e-14};
inline constexpr std::array arc_tangent_terms{-0.3333333333333323, 0.1999999999974516,   -0.14285714183588433,
                                              0.11111095735136392, -0.09089803585618467, 0.07651288365096777,
                                              -0.05902161747132724};

/// Less half turns, which only change signs.
[[gnu::always_inline]] inline void sine_cosine(const Lanes& angle, Lanes& sine, Lanes& cosine) {
  constexpr double shift = 0x1.8p52, half_turn = 3.141592653589793116, rest = 1.2246467991473532e-16;
  const Lanes shifted = angle * (1 / half_turn) + shift, turns = shifted - shift;
  const Lanes x = (angle - turns * half_turn) - turns * rest, z = x * x;
  const Bits sign = (Bits)shifted << 63;
  sine = (Lanes)((Bits)(x + x * z * polynomial(sine_terms, z)) ^ sign);
  cosine = (Lanes)((Bits)(1 + z * polynomial(cosine_terms, z)) ^ sign);
}

/// The angle of (cosine, sine); those from 0.2 on apart, as a controller that works has none.
[[gnu::noinline]] inline void any_arc_tangent(const Lanes& sine, const Lanes& cosine, Lanes& angle) {
  limpid::detail::arc_tangent<double, 4>(sine, cosine, angle);
}

}  // namespace limpid::bench::simd
