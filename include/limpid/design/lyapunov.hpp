// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/balance.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <limits>

namespace limpid {
namespace detail {

/// Solves A X + X A' + Q = 0 or A X A' - X + Q = 0 for a symmetric X, as linear equations in its lower triangle, by
/// elimination with a step of refinement. Not finite where they are singular.
template <Real Scalar>
class LyapunovSolver {
 public:
  using Matrix = DynamicMatrix<Scalar>;
  static constexpr Eigen::Index most_states = 100;  // 200 MB and some 10 s in double

  LyapunovSolver(const Matrix& A, bool discrete) : A_{A}, discrete_{discrete} {
    const Eigen::Index n = A.rows(), unknowns = n * (n + 1) / 2;
    expect(n <= most_states, "lyapunov: A", "at most 100 states", n);
    Matrix M = Matrix::Zero(unknowns, unknowns);
    for (Eigen::Index j = 0; j < n; ++j) {
      for (Eigen::Index i = j; i < n; ++i) set_row(M, i, j);
    }
    if (n > 0) lu_.compute(M);
  }

  [[nodiscard]] Matrix solve(const Matrix& Q) const {
    if (A_.rows() == 0) return Q;
    const Matrix X = once(Q);
    const Matrix AX = A_ * X;
    return X + once(discrete_ ? Matrix(AX * A_.transpose() - X + Q) : Matrix(AX + AX.transpose() + Q));
  }

 private:
  // Entry (i, j), i >= j, in the lower triangle by columns.
  [[nodiscard]] Eigen::Index place(Eigen::Index i, Eigen::Index j) const {
    return i >= j ? j * A_.rows() - j * (j - 1) / 2 + i - j : place(j, i);
  }

  // sum_k a_ik x_kj + x_ik a_jk    or    sum_kl a_ik x_kl a_jl - x_ij
  void set_row(Matrix& M, Eigen::Index i, Eigen::Index j) const {
    const Eigen::Index n = A_.rows(), row = place(i, j);
    for (Eigen::Index k = 0; k < n; ++k) {
      if (!discrete_) {
        M(row, place(k, j)) += A_(i, k);
        M(row, place(i, k)) += A_(j, k);
        continue;
      }
      for (Eigen::Index l = 0; l < n; ++l) M(row, place(k, l)) += A_(i, k) * A_(j, l);
    }
    if (discrete_) M(row, row) -= Scalar{1};
  }

  [[nodiscard]] Matrix once(const Matrix& Q) const {
    const Eigen::Index n = A_.rows();
    DynamicVector<Scalar> q(n * (n + 1) / 2);
    for (Eigen::Index j = 0; j < n; ++j) {
      for (Eigen::Index i = j; i < n; ++i) q[place(i, j)] = -Q(i, j);
    }
    const DynamicVector<Scalar> x = lu_.solve(q);
    Matrix X(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      for (Eigen::Index i = 0; i < n; ++i) X(i, j) = x[place(i, j)];
    }
    return X;
  }

  Matrix A_;
  bool discrete_;
  Eigen::PartialPivLU<Matrix> lu_;
};

template <Real Scalar>
[[nodiscard]] DynamicMatrix<Scalar> solve_lyapunov(const DynamicMatrix<Scalar>& A, const DynamicMatrix<Scalar>& Q,
                                                   bool discrete) {
  expect(A.rows() == A.cols() && is_finite(A), "lyapunov: A", "square and finite", A);
  expect(Q.rows() == A.rows() && Q.cols() == A.rows() && is_finite(Q), "lyapunov: Q", "of A's size and finite", Q);
  const Scalar rounding = Scalar(64) * std::numeric_limits<Scalar>::epsilon() * Q.norm();  // a product B B' has it
  expect((Q - Q.transpose()).norm() <= rounding, "lyapunov: Q", "symmetric", Q);
  const DynamicVector<Scalar> d = balancing<Scalar>(A), inverse = d.cwiseInverse();
  const LyapunovSolver<Scalar> solver(inverse.asDiagonal() * A * d.asDiagonal(), discrete);
  const DynamicMatrix<Scalar> X = solver.solve(inverse.asDiagonal() * Q * inverse.asDiagonal());
  return d.asDiagonal() * X * d.asDiagonal();
}

}  // namespace detail

/// X of A X + X A' + Q = 0. The solution is unique where no two eigenvalues of A add up to zero, as with a stable A;
/// not finite where the equation is singular. Off line: n^6/12 flops, 10 us for n = 6, a second for n = 60.
/// @throws std::invalid_argument  where A or Q is not finite, the sizes do not fit, Q is not symmetric or n above 100
template <Real Scalar>
[[nodiscard]] detail::DynamicMatrix<Scalar> lyapunov(const detail::DynamicMatrix<Scalar>& A,
                                                     const detail::DynamicMatrix<Scalar>& Q) {
  return detail::solve_lyapunov<Scalar>(A, Q, false);
}

/// X of A X A' - X + Q = 0, as above, with products of eigenvalues that are not one.
/// @throws std::invalid_argument  as `lyapunov`
template <Real Scalar>
[[nodiscard]] detail::DynamicMatrix<Scalar> discrete_lyapunov(const detail::DynamicMatrix<Scalar>& A,
                                                              const detail::DynamicMatrix<Scalar>& Q) {
  return detail::solve_lyapunov<Scalar>(A, Q, true);
}

}  // namespace limpid
