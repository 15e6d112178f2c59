// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/core/unroll.hpp>
#include <limpid/estimation/any_above.hpp>
#include <limpid/estimation/largest_eigenvalue.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <limits>

namespace limpid {

/// Symmetric positive definite matrices Gamma = U D U', one a lane: U unit upper triangular, D diagonal and positive.
///
/// A rank-one downdate multiplies D by positive numbers only (Bierman), so that Gamma stays definite in any precision
/// (as long as D is in range, see `is_resolved`); a subtraction from Gamma itself would not.
/// @tparam N      order of the matrices
/// @tparam Array  the lanes, a fixed-size `Eigen::Array`
template <int N, typename Array>
class UDFactors {
 public:
  using Scalar = typename Array::Scalar;
  using Columns = std::array<Array, N>;
  using Matrix = Eigen::Matrix<Scalar, N, N>;

  /// A regressor phi as the factors see it.
  struct Direction {
    Columns f;  ///< U' phi
    Columns v;  ///< D U' phi
    Array s;    ///< phi' Gamma phi
  };

  /// The least D, far below any gain of use: D still has all its digits, and no rounding of U D U' is beyond its size.
  static Scalar floor() noexcept { return std::numeric_limits<Scalar>::min() / std::numeric_limits<Scalar>::epsilon(); }

  UDFactors() = default;  // unset
  explicit UDFactors(const Columns& diagonal) noexcept : D_{diagonal} { U_.fill(Array::Zero()); }

  [[nodiscard]] Direction along(const Columns& phi) const noexcept {
    Direction seen;
    seen.s = Array::Zero();
    LIMPID_UNROLL
    for (std::size_t j = 0; j < n; ++j) {
      seen.f[j] = phi[j];
      LIMPID_UNROLL
      for (std::size_t i = 0; i < j; ++i) seen.f[j] += U_[at(i, j)] * phi[i];
      seen.v[j] = D_[j] * seen.f[j];
      seen.s += seen.f[j] * seen.v[j];
    }
    return seen;
  }

  /// Gamma <- Gamma - Gamma phi phi' Gamma u / (1 + s u), that is Gamma^-1 <- Gamma^-1 + u phi phi'; u >= 0.
  /// @return the gain u / (1 + s u) Gamma phi, of the old Gamma
  Columns downdate(const Direction& seen, const Array& u) noexcept {
    Columns b;
    Array a = Array::Ones(), inverse = Array::Ones();  // 1 + u (f_0 v_0 + ... + f_(j-1) v_(j-1)), and 1 over it
    LIMPID_UNROLL
    for (std::size_t j = 0; j < n; ++j) {
      const Array raised = a + u * (seen.f[j] * seen.v[j]);
      const Array raised_inverse = raised.inverse();
      LIMPID_UNROLL
      for (std::size_t i = 0; i < j; ++i) {
        const Array slope = b[i] * inverse;
        b[i] += U_[at(i, j)] * seen.v[j];
        U_[at(i, j)] -= slope * (u * seen.f[j]);
      }
      b[j] = seen.v[j];
      D_[j] *= a * raised_inverse;
      a = raised;
      inverse = raised_inverse;
    }
    LIMPID_UNROLL
    for (auto& entry : b) entry *= u * inverse;
    return b;
  }

  void scale(const Array& factor) noexcept {
    LIMPID_UNROLL
    for (auto& entry : D_) entry *= factor;
  }

  [[nodiscard]] Array trace() const noexcept {
    Array sum = D_[0];
    LIMPID_UNROLL
    for (std::size_t j = 1; j < n; ++j) {
      Array column = Array::Ones();
      LIMPID_UNROLL
      for (std::size_t i = 0; i < j; ++i) column += U_[at(i, j)].square();
      sum += column * D_[j];
    }
    return sum;
  }

  /// Whether D >= floor().
  [[nodiscard]] bool is_resolved() const noexcept {
    Array least = D_[0];
    LIMPID_UNROLL
    for (std::size_t j = 1; j < n; ++j) least = least.min(D_[j]);
    return !any_above(Array(-least), Scalar(-floor()));
  }

  /// Finite exactly where all factors are (short of overflow in the sum itself).
  [[nodiscard]] Array sum() const noexcept {
    Array total = D_[0];
    LIMPID_UNROLL
    for (std::size_t j = 1; j < n; ++j) total += D_[j];
    for (const auto& entry : U_) total += entry;
    return total;
  }

  [[nodiscard]] Matrix U(int lane) const noexcept {
    Matrix upper = Matrix::Identity();
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < j; ++i) upper(int(i), int(j)) = U_[at(i, j)][lane];
    }
    return upper;
  }

  [[nodiscard]] Eigen::Matrix<Scalar, N, 1> D(int lane) const noexcept {
    Eigen::Matrix<Scalar, N, 1> diagonal;
    for (std::size_t j = 0; j < n; ++j) diagonal[int(j)] = D_[j][lane];
    return diagonal;
  }

  [[nodiscard]] Matrix product(int lane) const noexcept {
    const Matrix upper = U(lane);
    return upper * D(lane).asDiagonal() * upper.transpose();
  }

  /// lambda_max(Gamma) times `scale`, which takes Gamma's entries to where their squares do not overflow.
  [[nodiscard]] Array largest_eigenvalue(const Scalar& scale) const noexcept {
    SymmetricLanes<N, Array> product;
    LIMPID_UNROLL
    for (std::size_t j = 0; j < n; ++j) {
      const Array d = D_[j] * scale;
      LIMPID_UNROLL
      for (std::size_t i = 0; i < j; ++i) {
        const Array column = U_[at(i, j)] * d;
        LIMPID_UNROLL
        for (std::size_t k = i; k < j; ++k) product(int(i), int(k)) += column * U_[at(k, j)];
        product(int(i), int(j)) = column;
      }
      product(int(j), int(j)) = d;
    }
    return limpid::largest_eigenvalue<N, Array>(product);
  }

 private:
  static constexpr std::size_t n = N;
  static constexpr std::size_t at(std::size_t i, std::size_t j) { return j * (j - 1) / 2 + i; }  // i < j

  Columns D_;
  std::array<Array, n*(n - 1) / 2> U_;  // above the diagonal, by columns
};

}  // namespace limpid
