// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/design/dynamic_block.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <vector>

/// What the Schur matrix M_ij = <F_i, Z F_j S^-1> of one block is made of, in two ways.
namespace limpid::detail {

/// For small blocks on which many variables depend: <E_p, Z E_q S^-1> for each two places p and q, E_p being what is 1
/// at p and at its mirror image, and half of that for places on the diagonal counted twice: 2 there.
///
/// For q = (s, u) that is X + X', X = z_s s_u' + z_u s_s' in the columns of Z and of S^-1. Of each of its columns the
/// parts from the diagonal on are stored, one column after the other.
template <Real Scalar>
class PlaceProducts {
 public:
  using Matrix = DynamicBlock<Scalar>;
  static constexpr int lanes = Matrix::lanes;

  /// Where a place is stored, and how much there is in all.
  [[nodiscard]] static constexpr int index(int row, int col, int parts) {
    const int whole = col / lanes, rest = col % lanes;  // columns before: `lanes` with each number of parts
    const int before = lanes * (whole * parts - whole * (whole - 1) / 2) + rest * (parts - whole);
    return before * lanes + row - whole * lanes;
  }
  [[nodiscard]] static constexpr int size(int n, int parts) { return index(n / lanes * lanes, n, parts); }

  /// Those of q = (s, u).
  static void write(const Matrix& Z, const Matrix& S_inverse, int s, int u, Scalar* to) {
    const Scalar *const z_s = &Z(0, s), *const z_u = &Z(0, u), *const s_s = &S_inverse(0, s),
                        *const s_u = &S_inverse(0, u);
    for (int col = 0; col < Z.rows(); ++col) {
      const Scalar by_z_s = s_u[col], by_z_u = s_s[col], by_s_u = z_s[col], by_s_s = z_u[col];
      for (int row = col / lanes * lanes; row < Z.stride(); row += lanes, to += lanes) {
        Matrix::store(Matrix::load(z_s + row) * by_z_s + Matrix::load(z_u + row) * by_z_u +
                          Matrix::load(s_u + row) * by_s_u + Matrix::load(s_s + row) * by_s_s,
                      to);
      }
    }
  }
};

/// For all others U = Z F S^-1 for a coefficient F given by its entries, by Eigen's products: begin, add_row for each
/// entry and its mirror image, multiply; then what an entry (r, c), r >= c, of a symmetric matrix is weighed with in
/// <., U>: U_rc + U_cr, twice what it should be on the diagonal. Rows of F that are zero are left out.
template <Real Scalar>
class CoefficientProduct {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  CoefficientProduct(const DynamicBlock<Scalar>& Z, const DynamicBlock<Scalar>& S_inverse)
      : Z_{Z.matrix()},
        S_inverse_{S_inverse.matrix()},
        T_(Z.rows(), Z.rows()),
        left_(Z.rows(), Z.rows()),
        U_(Z.rows(), Z.rows()),
        position_(static_cast<std::size_t>(Z.rows())) {}

  void begin() {
    used_ = 0;
    std::fill(position_.begin(), position_.end(), -1);
  }
  void add_row(int row, int col, const Scalar& value) {
    Eigen::Index& place = position_[static_cast<std::size_t>(row)];
    if (place < 0) {
      place = used_++;
      T_.col(place).setZero();
      left_.col(place) = Z_.col(row);
    }
    T_.col(place) += value * S_inverse_.col(col);
  }
  void multiply() { U_.noalias() = left_.leftCols(used_) * T_.leftCols(used_).transpose(); }
  [[nodiscard]] Scalar operator()(int r, int c) const { return U_(r, c) + U_(c, r); }

 private:
  Matrix Z_, S_inverse_, T_, left_, U_;
  std::vector<Eigen::Index> position_;
  Eigen::Index used_ = 0;
};

}  // namespace limpid::detail
