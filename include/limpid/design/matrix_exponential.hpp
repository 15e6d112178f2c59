// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/balance.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace limpid {

/// exp(A), by the diagonal Pade approximant of the balanced and halved matrix, squared back. With |A|/2^k <= 1/2 the
/// approximant of degree q is exp(A + E), |E| <= 8 |A| 2^(-2q) q!^2/((2q)! (2q + 1)!) (Moler and Van Loan); q is taken
/// such that this is below the rounding of any scalar. Not finite where the result is not. Off line.
/// @throws std::invalid_argument  where A is not square or not finite
template <Real Scalar>
[[nodiscard]] detail::DynamicMatrix<Scalar> matrix_exponential(const detail::DynamicMatrix<Scalar>& A) {
  using std::abs;
  using Matrix = detail::DynamicMatrix<Scalar>;
  expect(A.rows() == A.cols(), "matrix_exponential: A", "square", A);
  expect(is_finite(A), "matrix_exponential: A", "finite", A);
  const Eigen::Index n = A.rows();
  if (n == 0) return A;
  const detail::DynamicVector<Scalar> d = detail::balancing<Scalar>(A);
  Matrix X = d.cwiseInverse().asDiagonal() * A * d.asDiagonal();

  Scalar size{0};
  for (Eigen::Index i = 0; i < n; ++i) {
    Scalar row{0};
    for (Eigen::Index j = 0; j < n; ++j) row += abs(X(i, j));
    size = row > size ? row : size;
  }
  int halvings = 0;
  for (; size > Scalar{1} / Scalar{2} && is_finite(size); ++halvings) {
    size /= Scalar{2};
    X /= Scalar{2};
  }
  int q = 1;
  for (Scalar error = Scalar{1} / Scalar{3}; error > std::numeric_limits<Scalar>::epsilon() / Scalar{8}; ++q) {
    // the ratio of q!^2/((2q)! (2q + 1)!) to its predecessor, and 2^-2
    error /= Scalar(16) * Scalar(2 * q + 1) * Scalar(2 * q + 3);
  }

  Matrix term = Matrix::Identity(n, n), even = term, odd = Matrix::Zero(n, n);
  for (int k = 1; k <= q; ++k) {
    term = Matrix(X * term) * (Scalar(q - k + 1) / (Scalar(k) * Scalar(2 * q - k + 1)));
    (k % 2 == 0 ? even : odd) += term;
  }
  Matrix result = Matrix(even - odd).partialPivLu().solve(Matrix(even + odd));
  for (int i = 0; i < halvings; ++i) result = Matrix(result * result);
  return d.asDiagonal() * result * d.cwiseInverse().asDiagonal();
}

}  // namespace limpid
