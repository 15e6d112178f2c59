// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/design/block_matrix.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

/// U = Z F S^-1 for a coefficient F given by its entries, one block of dynamic size: begin, add_row for each entry and
/// its mirror image, multiply; then what an entry (r, c), r >= c, of a symmetric matrix is weighed with in <., U>:
/// U_rc + U_cr below the diagonal, U_rr on it. Rows of F that are zero are left out.
namespace limpid::detail {

/// For blocks up to small_block, in columns of whole lanes.
template <Real Scalar>
class SmallCoefficientProduct {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  SmallCoefficientProduct(const Matrix& Z, const Matrix& S_inverse)  // NOLINT(*-member-init): filled in its body
      : size_{static_cast<int>(Z.rows())}, chunks_{(size_ + 3) / 4} {
    for (int j = 0; j < size_; ++j) {
      for (int i = 0; i < 4 * chunks_; ++i) {
        Z_[at(i, j)] = i < size_ ? Z(i, j) : Scalar{0};
        S_inverse_[at(i, j)] = i < size_ ? S_inverse(i, j) : Scalar{0};
      }
    }
  }

  void begin() {
    used_ = 0;
    position_.fill(-1);
  }
  void add_row(int row, int col, const Scalar& value) {
    int& place = position_[static_cast<std::size_t>(row)];
    const bool first = place < 0;
    if (first) {
      rows_[static_cast<std::size_t>(used_)] = row;
      place = used_++;
    }
    for (int c = 0; c < chunks_; ++c) {
      const Quad part = value * chunk(S_inverse_, c, col);
      if (first) {
        chunk(T_, c, place) = part;
      } else {
        chunk(T_, c, place) += part;
      }
    }
  }
  void multiply() {
    switch (chunks_) {
      case 1:
        return multiply<1>();
      case 2:
        return multiply<2>();
      case 3:
        return multiply<3>();
      default:
        return multiply<4>();
    }
  }
  [[nodiscard]] const Scalar& operator()(int r, int c) const { return U_[at(r, c)]; }

 private:
  using Quad = Eigen::Array<Scalar, 4, 1, Eigen::DontAlign>;
  static constexpr int stride = static_cast<int>(small_block);
  using Columns = std::array<Scalar, static_cast<std::size_t>(stride) * stride>;

  [[nodiscard]] static constexpr std::size_t at(int i, int j) {
    return static_cast<std::size_t>(j * stride + i);  // NOLINT(bugprone-misplaced-widening-cast): below a thousand
  }
  [[nodiscard]] static Eigen::Map<Quad> chunk(Columns& A, int c, int j) { return Eigen::Map<Quad>(&A[at(4 * c, j)]); }

  // Column by column, each kept in registers.
  template <int chunks>
  void multiply() {
    using Column = Eigen::Array<Scalar, 4 * chunks, 1, Eigen::DontAlign>;
    const auto column = [](Columns& A, int j) { return Eigen::Map<Column>(&A[at(0, j)]); };
    for (int j = 0; j < size_; ++j) {
      Column sum = T_[at(j, 0)] * column(Z_, rows_[0]);
      for (int k = 1; k < used_; ++k) sum += T_[at(j, k)] * column(Z_, rows_[static_cast<std::size_t>(k)]);
      column(U_, j) = sum;
      for (int i = 0; i < j; ++i) U_[at(j, i)] += U_[at(i, j)];
    }
  }

  int size_, chunks_, used_ = 0;
  Columns Z_, S_inverse_, T_, U_;  // T: the rows of F S^-1 that are not zero, as columns
  std::array<int, static_cast<std::size_t>(stride)> position_, rows_;
};

/// For larger blocks, by Eigen's products.
template <Real Scalar>
class LargeCoefficientProduct {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  LargeCoefficientProduct(const Matrix& Z, const Matrix& S_inverse)
      : Z_{Z},
        S_inverse_{S_inverse},
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
  [[nodiscard]] Scalar operator()(int r, int c) const { return r == c ? U_(r, r) : Scalar(U_(r, c) + U_(c, r)); }

 private:
  const Matrix &Z_, &S_inverse_;
  Matrix T_, left_, U_;
  std::vector<Eigen::Index> position_;
  Eigen::Index used_ = 0;
};

}  // namespace limpid::detail
