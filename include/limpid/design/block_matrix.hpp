// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/pack.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

/// Small symmetric matrices, several side by side: what the interior point method works on.
namespace limpid::detail {

/// n x n, each entry in all lanes; n is fixed here, of dynamic size it is Eigen's.
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
using Block =
    std::conditional_t<n == Eigen::Dynamic, Eigen::Matrix<E, Eigen::Dynamic, Eigen::Dynamic>, FixedBlock<E, n>>;

template <typename E, int n>
void set_scaled_identity(FixedBlock<E, n>& A, const LaneScalar<E>& diagonal) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) A(i, j) = all_lanes<E>(i == j ? diagonal : LaneScalar<E>{0});
  }
}
template <typename Scalar>
void set_scaled_identity(Eigen::Matrix<Scalar, -1, -1>& A, const Scalar& diagonal) {
  A.setIdentity();
  A *= diagonal;
}

/// A += scale B
template <typename E, int n>
void add_scaled(FixedBlock<E, n>& A, const LaneScalar<E>& scale, const FixedBlock<E, n>& B) {
  for (std::size_t i = 0; i < A.entries.size(); ++i) A.entries[i] += B.entries[i] * scale;
}
template <typename Scalar>
void add_scaled(Eigen::Matrix<Scalar, -1, -1>& A, const Scalar& scale, const Eigen::Matrix<Scalar, -1, -1>& B) {
  A += scale * B;
}

/// A = own A + scale B
template <typename E, int n>
void scale_and_add(FixedBlock<E, n>& A, const LaneScalar<E>& own, const LaneScalar<E>& scale,
                   const FixedBlock<E, n>& B) {
  for (std::size_t i = 0; i < A.entries.size(); ++i) A.entries[i] = A.entries[i] * own + B.entries[i] * scale;
}
template <typename Scalar>
void scale_and_add(Eigen::Matrix<Scalar, -1, -1>& A, const Scalar& own, const Scalar& scale,
                   const Eigen::Matrix<Scalar, -1, -1>& B) {
  A = own * A + scale * B;
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
template <typename Scalar>
void multiply(const Eigen::Matrix<Scalar, -1, -1>& A, const Eigen::Matrix<Scalar, -1, -1>& B,
              Eigen::Matrix<Scalar, -1, -1>& C) {
  C.noalias() = A * B;
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
template <typename Scalar>
void multiply_symmetrised(const Eigen::Matrix<Scalar, -1, -1>& A, const Eigen::Matrix<Scalar, -1, -1>& B,
                          Eigen::Matrix<Scalar, -1, -1>& C) {
  const Eigen::Matrix<Scalar, -1, -1> product = A * B.transpose();
  C = (product + product.transpose()) / Scalar{2};
}

/// tr(A B) in each lane.
template <typename BlockType>
[[nodiscard]] EIGEN_ALWAYS_INLINE auto trace_of_product(const BlockType& A, const BlockType& B) {
  using E = std::remove_cvref_t<decltype(A(0, 0))>;
  if constexpr (requires { A.array(); }) {
    return E((A.array() * B.transpose().array()).sum());
  } else {
    E sum = A(0, 0) * B(0, 0);
    for (int i = 0; i < A.rows(); ++i) {
      for (int j = i == 0 ? 1 : 0; j < A.rows(); ++j) sum += A(i, j) * B(j, i);
    }
    return sum;
  }
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
/// Largest block of dynamic size for which plain loops beat Eigen's blocked ones.
inline constexpr Eigen::Index small_block = 16;

/// By A = L D L' and K = L^-1: A^-1 = K' D^-1 K. Sums run along columns, so that none waits for the one before it.
template <typename Scalar>
[[nodiscard]] bool invert_small(const Eigen::Matrix<Scalar, -1, -1>& A, Eigen::Matrix<Scalar, -1, -1>& inverse) {
  const Eigen::Index n = A.rows();
  std::array<Scalar, static_cast<std::size_t>(small_block * small_block)> L, K;
  std::array<Scalar, static_cast<std::size_t>(small_block)> reciprocal;
  const auto at = [n](Eigen::Index i, Eigen::Index j) { return static_cast<std::size_t>(j * n + i); };
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j; i < n; ++i) {
      L[at(i, j)] = A(i, j);
      K[at(i, j)] = Scalar{0};
    }
    K[at(j, j)] = Scalar{1};
  }
  for (Eigen::Index j = 0; j < n; ++j) {
    if (!(L[at(j, j)] > Scalar{0})) return false;
    const Scalar by_pivot = reciprocal[static_cast<std::size_t>(j)] = Scalar{1} / L[at(j, j)];
    for (Eigen::Index k = j + 1; k < n; ++k) {
      const Scalar multiple = L[at(k, j)] * by_pivot;
      for (Eigen::Index i = k; i < n; ++i) L[at(i, k)] -= multiple * L[at(i, j)];
      for (Eigen::Index c = 0; c <= j; ++c) K[at(k, c)] -= multiple * K[at(j, c)];
    }
  }
  inverse.resize(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j; i < n; ++i) {
      Scalar sum{0};
      for (Eigen::Index k = i; k < n; ++k) sum += K[at(k, i)] * K[at(k, j)] * reciprocal[static_cast<std::size_t>(k)];
      inverse(i, j) = inverse(j, i) = sum;
    }
  }
  return true;
}
template <typename Scalar>
[[nodiscard]] bool invert(const Eigen::Matrix<Scalar, -1, -1>& A, Eigen::Matrix<Scalar, -1, -1>& inverse) {
  if (A.rows() <= small_block) return invert_small(A, inverse);
  const Eigen::LLT<Eigen::Matrix<Scalar, -1, -1>> factor(A);
  if (factor.info() != Eigen::Success || !(factor.matrixLLT().diagonal().minCoeff() > Scalar{0})) return false;
  inverse.setIdentity(A.rows(), A.rows());
  factor.solveInPlace(inverse);
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
