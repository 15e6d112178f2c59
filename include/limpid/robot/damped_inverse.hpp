// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>

namespace limpid {

/// The joint rates of least norm that move the tip in a given way, q' = J' (J J')^-1 v, by the singular directions of
/// J.
///
/// A direction in which J's singular value sigma is below `edge` is damped by as much as sigma lacks,
/// 1/sigma^2 -> 1/edge^2: rates stay below |v| / edge, and the direction that the arm loses is given up alone
/// (numerical filtering, Maciejewski and Klein 1988).
/// @realtime  no allocation, no throw; the eigenvalues of a 3 x 3 matrix
template <int N, Real Scalar = double>
class DampedInverse {
 public:
  using Point = Eigen::Matrix<Scalar, 3, 1>;
  using Jacobian = Eigen::Matrix<Scalar, 3, N>;

  /// @param J     m/rad; finite, and so are its squares
  /// @param edge  smallest singular value that is left as it is, m/rad; its square is > 0
  DampedInverse(const Jacobian& J, const Scalar& edge) noexcept : J_{J} {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<Scalar, 3, 3>> directions(J * J.transpose());
    const Point& squares = directions.eigenvalues();  // ascending
    singular_ = !(squares[0] >= edge * edge);
    const auto& U = directions.eigenvectors();
    inverse_square_ = U * squares.cwiseMax(edge * edge).cwiseInverse().asDiagonal() * U.transpose();
  }

  /// Whether a direction is damped.
  [[nodiscard]] bool is_singular() const noexcept { return singular_; }

  /// q', refined once where nothing is damped: J J' has the square of J's condition.
  [[nodiscard]] Eigen::Matrix<Scalar, N, 1> operator()(const Point& v) const noexcept {
    const Eigen::Matrix<Scalar, N, 1> qdot = J_.transpose() * (inverse_square_ * v);
    if (singular_) return qdot;
    return qdot + J_.transpose() * (inverse_square_ * (v - J_ * qdot));
  }

 private:
  Jacobian J_;
  Eigen::Matrix<Scalar, 3, 3> inverse_square_;
  bool singular_;
};

}  // namespace limpid
