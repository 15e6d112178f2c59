// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace limpid::detail {

/// Where f changes its sign between a and b, to rounding: inverse quadratic interpolation where it is safe, else
/// bisection (Chandrupatla). f(a) and f(b), which are given, have different signs; f is finite between them. Of the
/// last bracket, the end with the smaller |f|.
template <Real Scalar, typename Function>
[[nodiscard]] Scalar bracketed_root(const Function& f, Scalar a, Scalar f_a, Scalar b, Scalar f_b) {
  using std::abs, std::sqrt;
  const int most_steps = 4 * std::numeric_limits<Scalar>::digits;
  Scalar c = a, f_c = f_a, part = Scalar{1} / Scalar{2};
  for (int step = 0; step < most_steps; ++step) {
    const Scalar x = a + part * (b - a), f_x = f(x);
    if ((f_x > Scalar{0}) == (f_a > Scalar{0})) {
      c = a, f_c = f_a;
    } else {
      c = b, f_c = f_b;
      b = a, f_b = f_a;
    }
    a = x, f_a = f_x;
    const Scalar& best = abs(f_a) < abs(f_b) ? a : b;
    if (f_a == Scalar{0}) return a;
    const Scalar tolerance = Scalar{2} * std::numeric_limits<Scalar>::epsilon() * abs(best) / abs(b - a);
    if (!(tolerance < Scalar{1} / Scalar{2})) return best;
    const Scalar xi = (a - b) / (c - b), phi = (f_a - f_b) / (f_c - f_b);
    part = Scalar{1} / Scalar{2};
    if (phi * phi < xi && (Scalar{1} - phi) * (Scalar{1} - phi) < Scalar{1} - xi) {
      part = f_a / (f_b - f_a) * (f_c / (f_b - f_c)) + (c - a) / (b - a) * (f_a / (f_c - f_a)) * (f_b / (f_c - f_b));
    }
    part = std::clamp<Scalar>(part, tolerance, Scalar{1} - tolerance);
  }
  return abs(f_a) < abs(f_b) ? a : b;
}

}  // namespace limpid::detail
