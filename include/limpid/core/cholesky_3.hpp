// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <cmath>

namespace limpid {

/// S = G G' of a symmetric positive definite 3 x 3 matrix, G lower triangular.
/// @realtime  no allocation, no throw for built-in scalars; three square roots. Of a matrix that is not positive
/// definite
///            G has entries that are not finite.
template <Real Scalar = double>
class Cholesky3 {
 public:
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  using Vector = Eigen::Matrix<Scalar, 3, 1>;

  explicit Cholesky3(const Matrix& S) noexcept {
    using std::sqrt;
    G_(0, 0) = sqrt(S(0, 0));
    G_(1, 0) = S(1, 0) / G_(0, 0);
    G_(2, 0) = S(2, 0) / G_(0, 0);
    G_(1, 1) = sqrt(S(1, 1) - G_(1, 0) * G_(1, 0));
    G_(2, 1) = (S(2, 1) - G_(2, 0) * G_(1, 0)) / G_(1, 1);
    G_(2, 2) = sqrt(S(2, 2) - G_(2, 0) * G_(2, 0) - G_(2, 1) * G_(2, 1));
  }

  [[nodiscard]] const Matrix& lower() const noexcept { return G_; }

  /// G^-1 y
  [[nodiscard]] Vector whitened(const Vector& y) const noexcept {
    const Scalar a = y[0] / G_(0, 0), b = (y[1] - G_(1, 0) * a) / G_(1, 1);
    return {a, b, (y[2] - G_(2, 0) * a - G_(2, 1) * b) / G_(2, 2)};
  }

  /// S^-1 y
  [[nodiscard]] Vector solve(const Vector& y) const noexcept {
    const Vector w = whitened(y);
    const Scalar c = w[2] / G_(2, 2), b = (w[1] - G_(2, 1) * c) / G_(1, 1);
    return {(w[0] - G_(1, 0) * b - G_(2, 0) * c) / G_(0, 0), b, c};
  }

  /// Logarithm of the determinant of S.
  [[nodiscard]] Scalar log_determinant() const noexcept {
    using std::log;
    return Scalar{2} * log(G_(0, 0) * G_(1, 1) * G_(2, 2));
  }

 private:
  Matrix G_ = Matrix::Zero();
};

}  // namespace limpid
