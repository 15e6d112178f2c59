// SPDX-License-Identifier: MIT
#pragma once

#include "design/palpation.hpp"
#include "support/precision.hpp"

#include <limpid/design/design_point.hpp>
#include <limpid/design/reduced_lmi.hpp>

#include <Eigen/Core>

/// The theorems in 50 digits and in full, (4.23) with N as printed: what certificates are held against. Nothing of the
/// library's own formulas is used but the coordinates of scaled_point.hpp.
namespace limpid::test {

template <int rows, int cols>
using FiftyMatrix = Eigen::Matrix<Fifty, rows, cols>;

template <typename Matrix>
bool positive_definite(Matrix A) {
  for (Eigen::Index j = 0; j < A.rows(); ++j) {
    if (!(A(j, j) > 0)) return false;
    for (Eigen::Index i = j + 1; i < A.rows(); ++i) {
      const Fifty factor = A(i, j) / A(j, j);
      for (Eigen::Index k = j + 1; k <= i; ++k) A(i, k) -= factor * A(k, j);
    }
  }
  return true;
}

inline FiftyMatrix<2, 2> in_fifty(const detail::Matrix2<double>& A) {
  FiftyMatrix<2, 2> result;
  result << Fifty(A.a11), Fifty(A.a12), Fifty(A.a21), Fifty(A.a22);
  return result;
}

/// Error dynamics (4.16) in scaled coordinates, d given.
struct FiftyPoint {
  FiftyMatrix<2, 2> A;
  FiftyMatrix<2, 2> BL;
  Fifty T, a2, a3;

  FiftyPoint(const PredictorDesign<double>& design, const Tissue<double>& tissue, const Gain<double>& L, double scale) {
    const Fifty m(design.tool.mass), d(scale);
    A << 0, 1, -(Fifty(design.tool.stiffness) + Fifty(tissue.stiffness)) / (m * d * d),
        -(Fifty(design.tool.damping) + Fifty(tissue.damping)) / (m * d);
    BL << 0, 0, Fifty(L[0]) / (m * d * d), Fifty(L[1]) / (m * d);
    T = d * Fifty(design.T_d);
    a2 = Fifty(design.a2);
    a3 = d * Fifty(design.a3);
  }

  [[nodiscard]] FiftyMatrix<6, 2> E() const {
    FiftyMatrix<6, 2> result;
    const FiftyMatrix<2, 2> I = FiftyMatrix<2, 2>::Identity();
    result << I, I * a2, I * a3;
    return result;
  }

  /// (4.24) for N1 = -R/T, N2 = R/T, N3 = 0 and M = 0: 8 x 8, to be negative definite after He(E M1 C) is added.
  [[nodiscard]] FiftyMatrix<8, 8> without_M(const FiftyMatrix<2, 2>& P, const FiftyMatrix<2, 2>& Q,
                                            const FiftyMatrix<2, 2>& R) const {
    const FiftyMatrix<2, 2> N1 = -R / T, N2 = R / T, O = FiftyMatrix<2, 2>::Zero();
    FiftyMatrix<8, 8> result;
    result << Q + N1 + N1.transpose(), N2.transpose() - N1, P, N1 * T,  //
        N2 - N1.transpose(), -Q - N2 - N2.transpose(), O, N2 * T,       //
        P, O, R * T, O,                                                 //
        N1.transpose() * T, N2.transpose() * T, O, -R * T;
    return result;
  }

  /// The same of the bars, X = M1^-1, with He(E [-A X'  -B L X'  X']) added.
  [[nodiscard]] FiftyMatrix<8, 8> with_gain(const FiftyMatrix<2, 2>& P, const FiftyMatrix<2, 2>& Q,
                                            const FiftyMatrix<2, 2>& R, const FiftyMatrix<2, 2>& X) const {
    FiftyMatrix<8, 8> result = without_M(P, Q, R);
    FiftyMatrix<2, 6> C;
    C << -A * X.transpose(), -BL * X.transpose(), X.transpose();
    const FiftyMatrix<6, 6> EC = E() * C;
    result.topLeftCorner<6, 6>() += EC + EC.transpose();
    return result;
  }
};

}  // namespace limpid::test
