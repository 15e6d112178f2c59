// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid::detail {

/// Whether all roots of p(z) = sum p_i z^i are smaller than `bound`: by the conditions of Schur and Cohn, which
/// need no roots. False where a coefficient is not finite or the bound not positive.
/// @realtime  no allocation where the type of the coefficients needs none; no throw; N^2 flops and more
template <typename Coefficients, typename Scalar = typename Coefficients::Scalar>
[[nodiscard]] bool roots_inside(Coefficients p, const Scalar& bound) noexcept {
  using std::abs;
  if (!(bound > Scalar{0})) return false;
  Scalar scale{1};
  for (Eigen::Index i = p.size() - 1; i >= 0; --i, scale /= bound) p[i] *= scale;
  // (p(z) - k p*(z))/z is one degree lower, and has one root fewer inside where |k| < 1.
  for (Eigen::Index N = p.size() - 1; N > 0; --N) {
    const Scalar k = p[0] / p[N];
    if (!(abs(k) < Scalar{1})) return false;
    for (Eigen::Index i = 0; 2 * i <= N; ++i) {
      const Scalar low = p[i], high = p[N - i];
      p[i] = low - k * high;
      p[N - i] = high - k * low;
    }
    for (Eigen::Index i = 0; i < N; ++i) p[i] = p[i + 1];
  }
  return true;
}

/// Largest magnitude of the roots of the monic p, by halving between two bounds.
///
/// The coefficient of z^(N-k) is the sum of (N over k) products of k roots; no root is larger than twice the largest
/// k-th root of these coefficients (Fujiwara).
template <typename Coefficients, typename Scalar = typename Coefficients::Scalar>
[[nodiscard]] Scalar root_radius(const Coefficients& p) noexcept {
  using std::abs, std::pow;
  const Eigen::Index N = p.size() - 1;
  Scalar lower{0}, upper{0}, binomial{1};
  for (Eigen::Index k = 1; k <= N; ++k) {
    binomial *= Scalar(static_cast<int>(N + 1 - k)) / Scalar(static_cast<int>(k));
    const Scalar size = abs(p[N - k]), part = Scalar{1} / Scalar(static_cast<int>(k));
    if (!(size > Scalar{0})) continue;
    lower = std::max<Scalar>(lower, pow(size / binomial, part));
    upper = std::max<Scalar>(upper, Scalar{2} * pow(size, part));
  }
  while (upper - lower > Scalar{2} * std::numeric_limits<Scalar>::epsilon() * upper) {
    const Scalar middle = lower + (upper - lower) / Scalar{2};
    if (!(lower < middle && middle < upper)) break;  // subnormal: there is no number between
    (roots_inside(p, middle) ? upper : lower) = middle;
  }
  return upper;
}

}  // namespace limpid::detail
