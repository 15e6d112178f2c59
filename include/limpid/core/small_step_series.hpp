// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <array>
#include <concepts>

namespace limpid::detail {

/// Coefficients c_2, c_3, ... near 1/n! for short steps of x'' + beta x' + kappa x = f: with B = beta h from 0 to 1/2,
/// K = kappa h^2 from 0 to 1/32, u_0 = 1, u_1 = -B, u_(n+1) = -B u_n - K u_(n-1), the responses
///
///     s/h^2 = sum c_(n+2) u_n to a step,     r/h^3 = sum c_(n+3) u_n to a ramp
///
/// are off by at most 7.5e-17 of 1/2 and 1/6, in float 1e-9, before the coefficients are rounded; as many terms of the
/// power series by 9e-13 and 2.5e-7. c_2 is kept; the others have the least largest error (Lawson's weights). The bound
/// is checked between the points of a grid too: the errors are polynomials of low degree (test/core).
template <Real Scalar>
struct SmallStepSeries {
  static constexpr double largest_B = 0.5, largest_K = 0.03125;
  static constexpr std::array coefficients{
      0.5,
      0.166666666666666657415,
      0.0416666666666662202645,
      0.00833333333332513144509,
      0.00138888888879198707169,
      1.98412697582176021215e-4,
      2.48015820316449855096e-5,
      2.75570664031222490578e-6,
      2.75484107805710919451e-7,
      2.48445109601800858987e-8,
      1.81205060486074028684e-9,
  };
};
template <>
struct SmallStepSeries<float> {
  static constexpr double largest_B = 0.5, largest_K = 0.03125;
  static constexpr std::array coefficients{0.5,
                                           0.166666666506528060587,
                                           0.0416666629430265875178,
                                           0.0083332938908513877474,
                                           0.00138861668639488566,
                                           1.97157202038432258825e-4,
                                           2.18114643427691185342e-5};
};

/// Whether there are coefficients to the scalar's precision.
template <Real Scalar>
inline constexpr bool has_small_step_series = std::same_as<Scalar, float> || std::same_as<Scalar, double>;

}  // namespace limpid::detail
