// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

namespace limpid {

/// Eigenvalues of a small symmetric matrix, in no order, by cyclic Jacobi rotations.
///
/// Rotations keep small eigenvalues of a definite matrix accurate where its diagonal is badly scaled, as with
/// parameters of different units.
/// @realtime  no allocation, no throw; at most 16 sweeps of N (N - 1) / 2 rotations; one for N = 2, 4 to 6 in practice
template <int N, Real Scalar>
[[nodiscard]] Eigen::Array<Scalar, N, 1> symmetric_eigenvalues(Eigen::Matrix<Scalar, N, N> A) noexcept {
  using std::abs;
  using std::sqrt;
  // Takes the entry (i, j) to zero: t is the tangent of the lesser angle that does.
  const auto rotate = [&A](int i, int j) {
    const Scalar tau = (A(j, j) - A(i, i)) / (Scalar{2} * A(i, j));
    const Scalar t = (tau < Scalar{0} ? Scalar{-1} : Scalar{1}) / (abs(tau) + sqrt(Scalar{1} + tau * tau));
    const Scalar c = Scalar{1} / sqrt(Scalar{1} + t * t), s = t * c;
    A(i, i) -= t * A(i, j);
    A(j, j) += t * A(i, j);
    A(i, j) = Scalar{0};
    for (int k = 0; k < N; ++k) {
      if (k == i || k == j) continue;
      Scalar& ki = k < i ? A(k, i) : A(i, k);
      Scalar& kj = k < j ? A(k, j) : A(j, k);
      const Scalar old = ki;
      ki = c * old - s * kj;
      kj = s * old + c * kj;
    }
  };
  const Scalar tiny = std::numeric_limits<Scalar>::epsilon() / Scalar{16};
  for (int sweep = 0; sweep < 16; ++sweep) {
    bool diagonal = true;
    for (int i = 0; i < N; ++i) {
      for (int j = i + 1; j < N; ++j) {
        if (!(abs(A(i, j)) > tiny * sqrt(abs(A(i, i))) * sqrt(abs(A(j, j))))) continue;
        diagonal = false;
        rotate(i, j);
      }
    }
    if (diagonal) break;
  }
  return A.diagonal().array();
}

}  // namespace limpid
