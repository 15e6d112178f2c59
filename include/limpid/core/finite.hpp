// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/any_lane.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>

namespace limpid {

/// Whether every entry is finite. Types of signals add an overload of their own, found by argument-dependent
/// lookup.
/// @realtime  no allocation for fixed sizes
template <typename Derived>
[[nodiscard]] bool is_finite(const Eigen::DenseBase<Derived>& values) noexcept {
  using Scalar = typename Derived::Scalar;
  if constexpr (std::floating_point<Scalar>) {
    // zero times a finite number is zero, times any other it is NaN: one test for all entries
    return (values.derived() * Scalar{0}).sum() == Scalar{0};
  } else {
    bool finite = true;
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      for (Eigen::Index j = 0; j < values.cols(); ++j) finite = finite && is_finite(values.derived()(i, j));
    }
    return finite;
  }
}

/// Whether every entry of arrays of one shape is finite: one test for all, as above.
/// @realtime  no allocation
template <typename First, typename... Rest>
[[nodiscard]] EIGEN_ALWAYS_INLINE bool are_finite(const Eigen::ArrayBase<First>& first,
                                                  const Eigen::ArrayBase<Rest>&... rest) noexcept {
  using Scalar = typename First::Scalar;
  const Scalar none{0};
  if constexpr (detail::in_packets<First> && First::ColsAtCompileTime == 1) {
    const Eigen::Array<Scalar, First::SizeAtCompileTime, 1, Eigen::DontAlign> zero =
        ((first.derived() * none) + ... + (rest.derived() * none));
    return !detail::any_entry(
        [](auto& mask, const auto& z) __attribute__((always_inline)) { mask = z != Scalar{0}; }, zero);
  } else {
    return ((first.derived() * none) + ... + (rest.derived() * none)).sum() == none;
  }
}

}  // namespace limpid
