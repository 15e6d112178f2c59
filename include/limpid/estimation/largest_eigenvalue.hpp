// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/lane_select.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/unroll.hpp>
#include <limpid/estimation/any_above.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <limits>

namespace limpid {

/// Symmetric matrices, one a lane: the upper triangle by columns.
template <int N, typename Array>
class SymmetricLanes {
 public:
  [[nodiscard]] Array& operator()(int i, int j) noexcept { return upper_[i < j ? at(i, j) : at(j, i)]; }
  [[nodiscard]] const Array& operator()(int i, int j) const noexcept { return upper_[i < j ? at(i, j) : at(j, i)]; }

 private:
  static constexpr std::size_t at(int i, int j) {
    return std::size_t(j) * (std::size_t(j) + 1) / 2 + std::size_t(i);
  }  // i <= j

  std::array<Array, std::size_t(N*(N + 1) / 2)> upper_;
};

namespace detail {

/// Jacobi's rotation, in each lane by the lesser angle that takes the entry (i, j) to zero. Where the squares underflow
/// it is one up to that of 1, and what is left is as small as the entry.
template <int N, typename Array>
EIGEN_ALWAYS_INLINE void rotate_away(SymmetricLanes<N, Array>& A, int i, int j) noexcept {
  using Scalar = typename Array::Scalar;
  const Scalar one{1}, tiny = std::numeric_limits<Scalar>::min();
  const Array difference = A(j, j) - A(i, i), twice = Scalar{2} * A(i, j);
  const Array length = (difference * difference + twice * twice).sqrt();
  const Array tangent = (twice / (difference.abs() + length + tiny)).min(one).max(-one);
  const Array t = where_positive<Array>(difference, tangent, -tangent);
  const Array c = (one + t * t).sqrt().inverse(), s = t * c;
  A(i, i) -= t * A(i, j);
  A(j, j) += t * A(i, j);
  A(i, j) = Array::Zero();
  LIMPID_UNROLL
  for (int k = 0; k < N; ++k) {
    if (k == i || k == j) continue;
    const Array old = A(k, i);
    A(k, i) = c * old - s * A(k, j);
    A(k, j) = s * old + c * A(k, j);
  }
}

/// Takes the largest diagonal entry; whether what lies beside the diagonal, R in all, adds no more than roundings to
/// it: at most R, and R^2 over the distance of the second largest.
template <int N, typename Array>
EIGEN_ALWAYS_INLINE bool is_largest(const SymmetricLanes<N, Array>& A, Array& largest) noexcept {
  using Scalar = typename Array::Scalar;
  Array second = Array::Zero(), rest = Array::Zero();
  largest = A(0, 0);
  LIMPID_UNROLL
  for (int j = 1; j < N; ++j) {
    second = second.max(largest.min(A(j, j)));
    largest = largest.max(A(j, j));
    LIMPID_UNROLL
    for (int i = 0; i < j; ++i) rest += A(i, j).abs();
  }
  const Array rounding = largest * (std::numeric_limits<Scalar>::epsilon() / Scalar{4});
  const Array distance = (largest - second).max(rounding);
  return !any_above(Array(rest * rest - rounding * distance), Scalar{0});
}

}  // namespace detail

/// Largest eigenvalues of semidefinite matrices, all lanes at once and each to a few roundings of itself: for N = 2 in
/// closed form, a sum of nothing negative, beyond by Jacobi rotations until what is left does not count in any lane.
/// @param A   entries of which neither squares nor their sums overflow
/// @realtime  no allocation, no throw; at most 16 sweeps of N (N - 1) / 2 rotations, each with two roots
template <int N, typename Array>
[[nodiscard]] EIGEN_ALWAYS_INLINE Array largest_eigenvalue(SymmetricLanes<N, Array> A) noexcept {
  using Scalar = typename Array::Scalar;
  if constexpr (N == 1) {
    return A(0, 0);
  } else if constexpr (N == 2) {
    const Array mean = (A(0, 0) + A(1, 1)) / Scalar{2}, half = (A(0, 0) - A(1, 1)) / Scalar{2};
    return mean + (half * half + A(0, 1) * A(0, 1)).sqrt();
  } else {
    Array largest;
    for (int sweep = 0; !detail::is_largest(A, largest) && sweep < 16; ++sweep) {
      LIMPID_UNROLL
      for (int i = 0; i < N; ++i) {
        LIMPID_UNROLL
        for (int j = i + 1; j < N; ++j) detail::rotate_away(A, i, j);
      }
    }
    return largest;
  }
}

}  // namespace limpid
