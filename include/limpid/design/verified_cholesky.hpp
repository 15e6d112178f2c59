// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/design/ball.hpp>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace limpid {

namespace detail {

template <Real Scalar>
[[nodiscard]] const Scalar& centre_of(const Scalar& exact) noexcept {
  return exact;
}
template <Real Scalar>
[[nodiscard]] const Scalar& centre_of(const Ball<Scalar>& ball) noexcept {
  return ball.centre();
}
template <Real Scalar>
[[nodiscard]] Scalar radius_of(const Scalar&) noexcept {
  return Scalar{0};
}
template <Real Scalar>
[[nodiscard]] Scalar radius_of(const Ball<Scalar>& ball) noexcept {
  return ball.radius();
}

template <typename Scalar>
struct ExactScalar {
  using type = Scalar;
};
template <typename Scalar>
struct ExactScalar<Ball<Scalar>> {
  using type = Scalar;
};

/// The scalar that is rounded: of a matrix of balls that of their centres.
template <typename Derived>
using RoundedScalar = typename ExactScalar<typename Derived::Scalar>::type;

/// Whether A is square and each entry is its mirror image; of balls, whether the two have a number in common.
template <typename Derived>
[[nodiscard]] bool is_symmetric(const Eigen::MatrixBase<Derived>& A) {
  using std::abs;
  if (A.rows() != A.cols()) return false;
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    for (Eigen::Index i = j + 1; i < A.rows(); ++i) {
      const auto &x = A.derived()(i, j), &y = A.derived()(j, i);
      if (!(abs(centre_of(x) - centre_of(y)) <= radius_of(x) + radius_of(y))) return false;
    }
  }
  return true;
}

/// The centres in the lower triangle of a symmetric matrix.
template <typename Derived>
[[nodiscard]] auto lower_centres(const Eigen::MatrixBase<Derived>& A) {
  using Scalar = RoundedScalar<Derived>;
  Eigen::Matrix<Scalar, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime> centres(A.rows(), A.cols());
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    for (Eigen::Index i = j; i < A.rows(); ++i) centres(i, j) = centre_of(A.derived()(i, j));
  }
  return centres;
}

/// Above the spectral norm of the radii: their largest row sum.
template <typename Derived>
[[nodiscard]] auto radius_norm(const Eigen::MatrixBase<Derived>& A) {
  using Scalar = RoundedScalar<Derived>;
  Scalar norm{0};
  if constexpr (!std::is_same_v<Scalar, typename Derived::Scalar>) {
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      Scalar sum{0};
      for (Eigen::Index j = 0; j < A.cols(); ++j) {
        sum += radius_of(i >= j ? A.derived()(i, j) : A.derived()(j, i));
      }
      if (!is_finite(sum)) return std::numeric_limits<Scalar>::infinity();  // of NaN too: nothing is proved
      norm = std::max<Scalar>(norm, sum);
    }
    norm *= Scalar{1} + Scalar(A.rows() + 1) * std::numeric_limits<Scalar>::epsilon();
  }
  return norm;
}

/// Whether A - shift I is positive definite, beyond doubt where true; A is destroyed.
///
/// The Cholesky factor that is computed belongs exactly to a matrix that differs by at most (n + 1) u tr / (1 - 2 (n +
/// 1) u) in norm, in any order of summation (S. M. Rump, Verification of positive definiteness, BIT 46, 2006), u half
/// of epsilon: it is taken from the diagonal first, twice as large, which pays for the rounding of the shift too.
template <typename Scalar, int n>
[[nodiscard]] bool cholesky_completes(Eigen::Matrix<Scalar, n, n>& A, const Scalar& shift) {
  using std::sqrt;
  const Eigen::Index size = A.rows();
  Scalar trace{0};
  for (Eigen::Index i = 0; i < size; ++i) {
    if (!(A(i, i) - shift > Scalar{0})) return false;
    trace += A(i, i) - shift;
  }
  const Scalar rounding = Scalar(size + 2) * std::numeric_limits<Scalar>::epsilon() * trace +
                          Scalar(16 * size * size) * std::numeric_limits<Scalar>::min();  // and underflow
  for (Eigen::Index j = 0; j < size; ++j) {
    Scalar pivot = (A(j, j) - shift) - rounding;
    for (Eigen::Index k = 0; k < j; ++k) pivot -= A(j, k) * A(j, k);
    if (!(pivot > Scalar{0}) || !is_finite(pivot)) return false;
    pivot = sqrt(pivot);
    for (Eigen::Index i = j + 1; i < size; ++i) {
      Scalar sum = A(i, j);
      for (Eigen::Index k = 0; k < j; ++k) sum -= A(i, k) * A(j, k);
      A(i, j) = sum / pivot;
    }
  }
  return true;
}

}  // namespace detail

/// Whether every symmetric matrix within `error_norm` of A, in spectral norm, is positive definite: a proof, with all
/// rounding accounted for, where true. False says nothing.
///
/// A that is not symmetric, to the last bit, is proved nothing of: take (A + A')/2. In a matrix of balls every
/// symmetric matrix of their numbers is meant; where an entry and its mirror image have no number in common there is
/// none.
/// @param error_norm  >= 0; nothing is proved otherwise
/// @realtime  no allocation for fixed sizes, no throw; n^3 / 3 flops
template <typename Derived>
[[nodiscard]] bool verified_positive_definite(const Eigen::MatrixBase<Derived>& A,
                                              const detail::RoundedScalar<Derived>& error_norm = {}) {
  using Scalar = detail::RoundedScalar<Derived>;
  if (!detail::is_symmetric(A) || !(error_norm >= Scalar{0})) return false;
  auto centres = detail::lower_centres(A);
  const Scalar error = detail::radius_norm(A) + error_norm;
  return detail::cholesky_completes(centres, error + error * std::numeric_limits<Scalar>::epsilon());
}

/// A proven lower bound of the least eigenvalue of a symmetric matrix or matrix of balls, close to it in practice;
/// -infinity where none was found, where A is not symmetric (as above) and where it is empty.
///
/// The eigenvalue is guessed, then shifted down until A less the guess is verified positive definite.
/// @realtime  no allocation for fixed sizes, no throw
template <typename Derived>
[[nodiscard]] auto verified_least_eigenvalue(const Eigen::MatrixBase<Derived>& A) {
  using Scalar = detail::RoundedScalar<Derived>;
  using Matrix = Eigen::Matrix<Scalar, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime>;
  const Scalar none = -std::numeric_limits<Scalar>::infinity();
  if (A.size() == 0 || !detail::is_symmetric(A)) return none;
  const auto centres = detail::lower_centres(A);
  const Scalar error = detail::radius_norm(A);
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    if (!is_finite(centres(i, i))) return none;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> guess(centres, Eigen::EigenvaluesOnly);
  if (guess.info() != Eigen::Success) return none;
  const Scalar spread = guess.eigenvalues()(A.rows() - 1) - guess.eigenvalues()(0);
  Scalar slack =
      error * Scalar{2} + Scalar(4 * A.rows() * (A.rows() + 2)) * std::numeric_limits<Scalar>::epsilon() * spread +
      Scalar(64 * A.rows() * A.rows()) * std::numeric_limits<Scalar>::min() +
      Scalar(8 * A.rows()) * std::numeric_limits<Scalar>::epsilon() * guess.eigenvalues().cwiseAbs().maxCoeff();
  for (int attempt = 0; attempt < 16; ++attempt, slack *= Scalar{8}) {
    const Scalar bound = guess.eigenvalues()(0) - slack;
    const Scalar shift = bound + error;
    using std::abs;
    auto shifted = centres;
    if (detail::cholesky_completes(shifted,
                                   shift + (abs(shift) + abs(bound)) * std::numeric_limits<Scalar>::epsilon())) {
      return bound;
    }
  }
  return none;
}

}  // namespace limpid
