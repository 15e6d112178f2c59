// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace limpid::test {

/// The larger of two; NaN where one is, as IEEE 754's `maximum` has it. std::max(worst, NaN) is `worst`, so that a
/// largest error found by it does not see what is not a number.
template <typename T>
[[nodiscard]] T maximum(const T& a, const T& b) {
  return a >= b || a != a ? a : b;
}

template <typename T, typename... More>
[[nodiscard]] T maximum(const T& a, const T& b, const More&... more) {
  return maximum(maximum(a, b), more...);
}

/// Largest |entry|; NaN where one is. Eigen's maxCoeff and lpNorm<Infinity> may miss it.
template <typename Derived>
[[nodiscard]] typename Derived::Scalar largest_entry(const Eigen::DenseBase<Derived>& of) {
  using std::abs;
  using Scalar = typename Derived::Scalar;
  const typename Derived::PlainObject values = of;
  Scalar largest{0};
  for (const Scalar& value : values.reshaped()) largest = maximum(largest, Scalar(abs(value)));
  return largest;
}

}  // namespace limpid::test
