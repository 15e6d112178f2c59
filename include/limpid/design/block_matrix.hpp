// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/pack.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

/// Small symmetric matrices, several side by side: what the interior point method works on.
namespace limpid::detail {

/// n x n, each entry in all lanes.
template <typename E, int n>
struct FixedBlock {
  std::array<E, static_cast<std::size_t>(n) * n> entries;

  [[nodiscard]] EIGEN_ALWAYS_INLINE E& operator()(int i, int j) { return entries[static_cast<std::size_t>(i * n + j)]; }
  [[nodiscard]] EIGEN_ALWAYS_INLINE const E& operator()(int i, int j) const {
    return entries[static_cast<std::size_t>(i * n + j)];
  }
  [[nodiscard]] static constexpr int rows() { return n; }
};

template <typename E, int n>
void set_scaled_identity(FixedBlock<E, n>& A, const LaneScalar<E>& diagonal) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) A(i, j) = all_lanes<E>(i == j ? diagonal : LaneScalar<E>{0});
  }
}

/// A += scale B
template <typename E, int n>
void add_scaled(FixedBlock<E, n>& A, const LaneScalar<E>& scale, const FixedBlock<E, n>& B) {
  for (std::size_t i = 0; i < A.entries.size(); ++i) A.entries[i] += B.entries[i] * scale;
}

/// A = own A + scale B
template <typename E, int n>
void scale_and_add(FixedBlock<E, n>& A, const LaneScalar<E>& own, const LaneScalar<E>& scale,
                   const FixedBlock<E, n>& B) {
  for (std::size_t i = 0; i < A.entries.size(); ++i) A.entries[i] = A.entries[i] * own + B.entries[i] * scale;
}

/// C = A B
template <typename E, int n>
[[gnu::noinline]] void multiply(const FixedBlock<E, n>& A, const FixedBlock<E, n>& B, FixedBlock<E, n>& C) {
  LIMPID_UNROLL
  for (int i = 0; i < n; ++i) {
    LIMPID_UNROLL
    for (int j = 0; j < n; ++j) {
      E sum = A(i, 0) * B(0, j);
      LIMPID_UNROLL
      for (int k = 1; k < n; ++k) sum += A(i, k) * B(k, j);
      C(i, j) = sum;
    }
  }
}

/// C = (A B' + B A') / 2, for symmetric A
template <typename E, int n>
[[gnu::noinline]] void multiply_symmetrised(const FixedBlock<E, n>& A, const FixedBlock<E, n>& B, FixedBlock<E, n>& C) {
  FixedBlock<E, n> product;
  LIMPID_UNROLL
  for (int i = 0; i < n; ++i) {
    LIMPID_UNROLL
    for (int j = 0; j < n; ++j) {
      E sum = A(i, 0) * B(j, 0);
      LIMPID_UNROLL
      for (int k = 1; k < n; ++k) sum += A(i, k) * B(j, k);
      product(i, j) = sum;
    }
  }
  LIMPID_UNROLL
  for (int i = 0; i < n; ++i) {
    LIMPID_UNROLL
    for (int j = 0; j <= i; ++j) {
      C(i, j) = (product(i, j) + product(j, i)) * (LaneScalar<E>{1} / LaneScalar<E>{2});
      C(j, i) = C(i, j);
    }
  }
}

/// tr(A B) in each lane.
template <typename BlockType>
[[nodiscard]] EIGEN_ALWAYS_INLINE auto trace_of_product(const BlockType& A, const BlockType& B) {
  using E = std::remove_cvref_t<decltype(A(0, 0))>;
  E sum = A(0, 0) * B(0, 0);
  for (int i = 0; i < A.rows(); ++i) {
    for (int j = i == 0 ? 1 : 0; j < A.rows(); ++j) sum += A(i, j) * B(j, i);
  }
  return sum;
}
/// The same summed over the lanes.
template <typename BlockType>
[[nodiscard, gnu::noinline]] auto inner_product_of(const BlockType& A, const BlockType& B) {
  return sum_of_lanes(trace_of_product(A, B));
}

/// By A = L D L', without square roots. False where A is not positive definite in every lane.
template <typename E, int n>
[[nodiscard, gnu::noinline]] bool invert(const FixedBlock<E, n>& A, FixedBlock<E, n>& inverse) {
  using Scalar = LaneScalar<E>;
  FixedBlock<E, n> L, K;  // K = L^-1; of both only what is below the diagonal
  std::array<E, static_cast<std::size_t>(n)> reciprocal;
  LIMPID_UNROLL
  for (int j = 0; j < n; ++j) {
    std::array<E, static_cast<std::size_t>(n)> LD;  // row j of L D
    E pivot = A(j, j);
    LIMPID_UNROLL
    for (int k = 0; k < j; ++k) {
      LD[static_cast<std::size_t>(k)] = L(j, k);
      L(j, k) = L(j, k) * reciprocal[static_cast<std::size_t>(k)];
      pivot -= LD[static_cast<std::size_t>(k)] * L(j, k);
    }
    if (!all_positive(pivot)) return false;
    reciprocal[static_cast<std::size_t>(j)] = all_lanes<E>(Scalar{1}) / pivot;
    LIMPID_UNROLL
    for (int i = j + 1; i < n; ++i) {
      E sum = A(i, j);
      LIMPID_UNROLL
      for (int k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);  // row i still holds L D
      L(i, j) = sum;
    }
  }
  LIMPID_UNROLL
  for (int j = 0; j < n; ++j) {
    LIMPID_UNROLL
    for (int i = j + 1; i < n; ++i) {
      E sum = -L(i, j);
      LIMPID_UNROLL
      for (int k = j + 1; k < i; ++k) sum -= L(i, k) * K(k, j);
      K(i, j) = sum;
    }
  }
  LIMPID_UNROLL
  for (int i = 1; i < n; ++i) {
    LIMPID_UNROLL
    for (int j = 0; j < i; ++j) L(i, j) = K(i, j) * reciprocal[static_cast<std::size_t>(i)];  // D^-1 K from here on
  }
  LIMPID_UNROLL
  for (int i = 0; i < n; ++i) {
    LIMPID_UNROLL
    for (int j = 0; j <= i; ++j) {
      // sum over k of K' D^-1 K, K with a diagonal of ones
      const E& by_pivot = reciprocal[static_cast<std::size_t>(i)];
      E sum = by_pivot;
      if (i != j) sum = by_pivot * K(i, j);
      LIMPID_UNROLL
      for (int k = i + 1; k < n; ++k) sum += L(k, i) * K(k, j);
      inverse(i, j) = sum;
      inverse(j, i) = sum;
    }
  }
  return true;
}

/// Below every eigenvalue of A in every lane: their mean less sqrt(n - 1) times their deviation.
template <typename BlockType>
[[nodiscard]] auto eigenvalue_bound_by_moments(const BlockType& A) {
  using E = std::remove_cvref_t<decltype(A(0, 0))>;
  using Scalar = LaneScalar<E>;
  using std::sqrt;
  const int n = static_cast<int>(A.rows());
  E trace = A(0, 0);
  for (int i = 1; i < n; ++i) trace += A(i, i);
  const E squares = trace_of_product(A, A);
  Scalar least = lane(trace, 0) / Scalar(n);
  for (int i = 0; i < LaneTraits<E>::width; ++i) {
    const Scalar mean = lane(trace, i) / Scalar(n);
    const Scalar variance = lane(squares, i) / Scalar(n) - mean * mean;
    const Scalar bound = variance > Scalar{0} ? Scalar(mean - sqrt(variance * Scalar(n - 1))) : mean;
    if (!(bound >= least)) least = bound;
  }
  return least;
}

/// How far A + alpha dA certainly stays positive definite, by one step of Laguerre's iteration on det(A + alpha dA):
/// its roots are real, so that it never passes the first. From tr G and tr G^2, G = A^-1 dA.
template <typename BlockType>
[[nodiscard, gnu::noinline]] auto laguerre_step(const BlockType& G) {
  using E = std::remove_cvref_t<decltype(G(0, 0))>;
  using Scalar = LaneScalar<E>;
  const int n = static_cast<int>(G.rows());
  E trace = G(0, 0);
  for (int i = 1; i < n; ++i) trace += G(i, i);
  const E squares = trace_of_product(G, G);
  const E spread = (squares * Scalar(n) - trace * trace) * Scalar(n - 1);
  const auto reach = [n](const Scalar& mean, const Scalar& square) -> Scalar {
    using std::sqrt;
    const Scalar slope = (square > Scalar{0} ? Scalar(sqrt(square)) : Scalar{0}) - mean;
    return slope > Scalar(n) / Scalar{1'000'000} ? Scalar(n) / slope : Scalar{1'000'000};
  };
  Scalar least{1'000'000};
  for (int i = 0; i < LaneTraits<E>::width; ++i) {
    const Scalar step = reach(lane(trace, i), lane(spread, i));
    if (!(step >= least)) least = step;
  }
  return least;
}

}  // namespace limpid::detail
