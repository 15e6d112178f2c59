// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace limpid::detail {

template <Real Scalar>
using DynamicMatrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <Real Scalar>
using DynamicVector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

template <Real Scalar>
[[nodiscard]] Scalar infinity_of() {
  return std::numeric_limits<Scalar>::infinity();
}

/// Powers of two d such that diag(d)^-1 A diag(d) has rows and columns of like size (Osborne; Parlett and Reinsch):
/// what follows then loses no digits to the units of the states, and the change itself rounds nothing.
template <Real Scalar>
[[nodiscard]] DynamicVector<Scalar> balancing(DynamicMatrix<Scalar> A) {
  using std::abs;
  constexpr int most_rounds = 100;
  const Eigen::Index n = A.rows();
  DynamicVector<Scalar> d = DynamicVector<Scalar>::Ones(n);
  bool changed = true;
  for (int round = 0; changed && round < most_rounds; ++round) {
    changed = false;
    for (Eigen::Index i = 0; i < n; ++i) {
      Scalar column{0}, row{0};
      for (Eigen::Index j = 0; j < n; ++j) {
        if (j == i) continue;
        column += abs(A(j, i));
        row += abs(A(i, j));
      }
      if (!(column > Scalar{0}) || !(row > Scalar{0})) continue;
      const Scalar before = column + row;
      Scalar f{1}, c = column, r = row;
      for (; c < r / Scalar{2}; f *= Scalar{2}) c *= Scalar{2}, r /= Scalar{2};
      for (; c > r * Scalar{2}; f /= Scalar{2}) c /= Scalar{2}, r *= Scalar{2};
      if (f == Scalar{1} || !(c + r < before * Scalar(0.96875))) continue;
      A.col(i) *= f;
      A.row(i) /= f;
      d[i] *= f;
      changed = true;
    }
  }
  return d;
}

/// diag(d)^-1 A diag(d) with the powers of two of `balancing`.
template <Real Scalar>
[[nodiscard]] DynamicMatrix<Scalar> balanced(const DynamicMatrix<Scalar>& A) {
  const DynamicVector<Scalar> d = balancing<Scalar>(A);
  return d.cwiseInverse().asDiagonal() * A * d.asDiagonal();
}

/// The largest sum of magnitudes in a row: a norm that takes no squares.
template <typename Derived>
[[nodiscard]] typename Derived::Scalar largest_row(const Eigen::MatrixBase<Derived>& A) {
  return A.cwiseAbs().rowwise().sum().maxCoeff();
}

/// Eigenvalues of the balanced matrix; none where it has entries that are not finite or the iteration does not end.
template <Real Scalar>
[[nodiscard]] std::vector<std::complex<Scalar>> eigenvalues_of(const DynamicMatrix<Scalar>& A) {
  if (A.rows() == 0 || !is_finite(A)) return {};
  const DynamicMatrix<Scalar> balanced_A = balanced<Scalar>(A);
  if (!is_finite(balanced_A)) return {};
  const Eigen::EigenSolver<DynamicMatrix<Scalar>> solver(balanced_A, false);
  if (solver.info() != Eigen::Success) return {};
  std::vector<std::complex<Scalar>> values;
  for (Eigen::Index i = 0; i < A.rows(); ++i) values.push_back(solver.eigenvalues()[i]);
  return values;
}

}  // namespace limpid::detail
