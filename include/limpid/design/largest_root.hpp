// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid::detail {

/// Largest magnitude of the roots of z^2 + b z + c.
template <Real Scalar>
[[nodiscard]] Scalar largest_root_magnitude(const Scalar& b, const Scalar& c) noexcept {
  using std::abs, std::sqrt;
  const Scalar half = b / Scalar{2}, discriminant = half * half - c;
  return discriminant < Scalar{0} ? sqrt(c) : abs(half) + sqrt(discriminant);
}

/// The real root of z^3 + a z^2 + b z + c that lies apart from the other two, in closed form and polished.
///
///     z = t - a/3,   t^3 + 3 P t - 2 Q = 0
template <Real Scalar>
[[nodiscard]] Scalar real_root_of_cubic(const Scalar& a, const Scalar& b, const Scalar& c) noexcept {
  using std::abs, std::acos, std::cbrt, std::cos, std::sqrt;
  const Scalar third = Scalar{1} / Scalar{3}, middle = -a * third;
  const Scalar P = (b + a * middle) * third, Q = ((middle + a) * middle + b) * middle * Scalar{-0.5} - c * Scalar{0.5};
  const Scalar cube = P * P * P, discriminant = Q * Q + cube;
  Scalar t{0};
  if (discriminant > Scalar{0}) {
    const Scalar u = cbrt(abs(Q) + sqrt(discriminant));
    t = u - P / u;
  } else if (cube < Scalar{0}) {
    const Scalar root = sqrt(-P);
    t = Scalar{2} * root * cos(third * acos(std::min<Scalar>(Scalar{1}, abs(Q) / (-P * root))));
  }
  Scalar x = middle + (Q < Scalar{0} ? -t : t);
  for (int i = 0; i < 2; ++i) {
    const Scalar q = x + a, r = q * x + b, slope = (x + q) * x + r;
    if (slope > Scalar{0}) x -= (r * x + c) / slope;
  }
  return x;
}

/// Largest magnitude of the roots of z^3 + a z^2 + b z + c. Simple roots come to a few units in the last place of the
/// coefficients' own uncertainty, a k-fold one to its k-th root.
/// @realtime  no allocation, no throw
template <Real Scalar>
[[nodiscard]] Scalar largest_root_magnitude(const Scalar& a, const Scalar& b, const Scalar& c) noexcept {
  using std::abs;
  if (c == Scalar{0}) return largest_root_magnitude(a, b);
  const Scalar x = real_root_of_cubic(a, b, c);
  // Deflation from the end at which x is large loses nothing: z^2 + q z + r.
  Scalar q = x + a, r = q * x + b;
  if (abs(x * x * x) > abs(c)) {
    r = -c / x;
    q = (r - b) / x;
  }
  return std::max<Scalar>(abs(x), largest_root_magnitude(q, r));
}

}  // namespace limpid::detail
