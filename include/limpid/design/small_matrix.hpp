// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/block_matrix.hpp>
#include <limpid/design/verified_cholesky.hpp>

#include <Eigen/Core>

/// Matrices of 2 x 2 and rows of two, of which larger blocks are put together. Each of their few operations exists once
/// for all scalars and balls; as Eigen's expressions they would cost the compiler minutes.
namespace limpid::detail {

template <typename S>
struct Row2 {
  S first{}, second{};

  [[nodiscard]] friend Row2 operator+(const Row2& a, const Row2& b) { return {a.first + b.first, a.second + b.second}; }
  [[nodiscard]] friend Row2 operator-(const Row2& a, const Row2& b) { return {a.first - b.first, a.second - b.second}; }
  [[nodiscard]] friend Row2 operator*(const Row2& a, const S& s) { return {a.first * s, a.second * s}; }
};

template <typename S>
struct Matrix2 {
  S a11{}, a12{}, a21{}, a22{};

  [[nodiscard]] Row2<S> second_row() const { return {a21, a22}; }

  [[nodiscard]] friend Matrix2 operator+(const Matrix2& A, const Matrix2& B) {
    return {A.a11 + B.a11, A.a12 + B.a12, A.a21 + B.a21, A.a22 + B.a22};
  }
  [[nodiscard]] friend Matrix2 operator-(const Matrix2& A, const Matrix2& B) {
    return {A.a11 - B.a11, A.a12 - B.a12, A.a21 - B.a21, A.a22 - B.a22};
  }
  [[nodiscard]] friend Matrix2 operator-(const Matrix2& A) { return {-A.a11, -A.a12, -A.a21, -A.a22}; }
  [[nodiscard]] friend Matrix2 operator*(const Matrix2& A, const S& s) {
    return {A.a11 * s, A.a12 * s, A.a21 * s, A.a22 * s};
  }
  [[nodiscard]] friend Matrix2 operator*(const Matrix2& A, const Matrix2& B) {
    return {A.a11 * B.a11 + A.a12 * B.a21, A.a11 * B.a12 + A.a12 * B.a22, A.a21 * B.a11 + A.a22 * B.a21,
            A.a21 * B.a12 + A.a22 * B.a22};
  }
  [[nodiscard]] friend Row2<S> operator*(const Row2<S>& a, const Matrix2& B) {
    return {a.first * B.a11 + a.second * B.a21, a.first * B.a12 + a.second * B.a22};
  }
  [[nodiscard]] friend Matrix2 transpose(const Matrix2& A) { return {A.a11, A.a21, A.a12, A.a22}; }
  /// A + A'
  [[nodiscard]] friend Matrix2 he(const Matrix2& A) { return A + transpose(A); }
};

/// a' b
template <typename S>
[[nodiscard]] Matrix2<S> outer(const Row2<S>& a, const Row2<S>& b) {
  return {a.first * b.first, a.first * b.second, a.second * b.first, a.second * b.second};
}

template <typename S>
[[nodiscard]] Matrix2<S> symmetric(const S& a11, const S& a21, const S& a22) {
  return {a11, a21, a21, a22};
}

template <typename S, int n>
using Square = FixedBlock<S, n>;

template <typename S, int n>
[[nodiscard]] Matrix2<S> get_block(const Square<S, n>& F, int row, int col) {
  return {F(row, col), F(row, col + 1), F(row + 1, col), F(row + 1, col + 1)};
}
template <typename S>
[[nodiscard]] Square<S, 2> square(const Matrix2<S>& A) {
  return {{A.a11, A.a12, A.a21, A.a22}};
}
/// Sets A at (row, col) and A' at its mirror image.
template <typename S, int n>
void set_block(Square<S, n>& F, int row, int col, const Matrix2<S>& A) {
  F(row, col) = F(col, row) = A.a11;
  F(row, col + 1) = F(col + 1, row) = A.a12;
  F(row + 1, col) = F(col, row + 1) = A.a21;
  F(row + 1, col + 1) = F(col + 1, row + 1) = A.a22;
}

template <typename S, typename Other>
[[nodiscard]] Row2<S> convert(const Row2<Other>& a) {
  return {S(a.first), S(a.second)};
}
template <typename S, typename Other>
[[nodiscard]] Matrix2<S> convert(const Matrix2<Other>& A) {
  return {S(A.a11), S(A.a12), S(A.a21), S(A.a22)};
}
template <typename S, typename Other, int n>
[[nodiscard]] Square<S, n> convert(const Square<Other, n>& A) {
  Square<S, n> result;
  for (std::size_t i = 0; i < A.entries.size(); ++i) result.entries[i] = S(A.entries[i]);
  return result;
}
template <Real Scalar>
[[nodiscard]] Matrix2<Scalar> centre_of_each(const Matrix2<Ball<Scalar>>& A) {
  return {A.a11.centre(), A.a12.centre(), A.a21.centre(), A.a22.centre()};
}
template <Real Scalar>
[[nodiscard]] Row2<Scalar> centre_of_each(const Row2<Ball<Scalar>>& a) {
  return {a.first.centre(), a.second.centre()};
}
template <typename S, int n>
void add(Square<S, n>& A, const Square<S, n>& B) {
  for (std::size_t i = 0; i < A.entries.size(); ++i) A.entries[i] = A.entries[i] + B.entries[i];
}

/// A proof where true; of a matrix that is not symmetric to the last bit nothing is proved.
template <typename S, int n>
[[nodiscard, gnu::noinline]] bool proves_positive(const Square<S, n>& A,
                                                  const typename ExactScalar<S>::type& error_norm = {}) {
  Eigen::Matrix<S, n, n> copy;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) copy(i, j) = A(i, j);
  }
  return verified_positive_definite(copy, error_norm);
}
template <typename S>
[[nodiscard]] bool proves_positive(const Matrix2<S>& A) {
  return proves_positive(square(A));
}
/// Certificates come from outside too: products that read one triangle or the other are sound only where they agree.
template <Real Scalar>
[[nodiscard]] bool is_symmetric(const Matrix2<Scalar>& A) {
  return A.a12 == A.a21;
}

}  // namespace limpid::detail
