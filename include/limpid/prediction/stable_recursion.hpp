// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

namespace limpid {

/// Whether all roots of z^n - a_1 z^(n-1) - ... - a_n, which y[k] = a_1 y[k-1] + ... + a_n y[k-n] grows by, lie inside
/// the circle of a radius; by the recursion of Schur and Cohn, which steps the degree down.
/// @param a       a_1 to a_n
/// @param radius  > 0
/// @realtime      no allocation, no throw; some 2 n^2 flops
template <int Order, Real Scalar, typename Derived>
[[nodiscard]] bool roots_within(const Eigen::ArrayBase<Derived>& a, const Scalar& radius) noexcept {
  Eigen::Array<Scalar, Order, 1> c;  // of the polynomial in z / radius, after its leading 1
  Scalar scale{1};
  for (int i = 0; i < Order; ++i) c[i] = -a[i] * (scale /= radius);
  for (int degree = Order; degree > 0; --degree) {
    const Scalar last = c[degree - 1], rest = Scalar{1} - last * last;
    if (!(rest > Scalar{0})) return false;
    const Eigen::Array<Scalar, Order, 1> before = c;
    for (int i = 0; i + 1 < degree; ++i) c[i] = (before[i] - last * before[degree - 2 - i]) / rest;
  }
  return true;
}

}  // namespace limpid
