// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/pack.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>

/// Symmetric matrices whose size is known at run time only, and what the interior point method does with them. Columns
/// are of whole registers, so that no loop has a remainder; up to `small_block` that beats Eigen's blocked products.
namespace limpid::detail {

/// A square matrix; below its last row zeros up to a whole number of parts.
template <Real Scalar>
class DynamicBlock {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Part = Entry<Scalar, fills_lanes<Scalar> ? 4 : 1>;  ///< of a column
  static constexpr int lanes = LaneTraits<Part>::width;

  DynamicBlock() = default;
  explicit DynamicBlock(int size)
      : size_{size}, parts_{(size + lanes - 1) / lanes}, entries_{Matrix::Zero(lanes * parts_, size)} {}

  [[nodiscard]] int rows() const { return size_; }
  [[nodiscard]] int parts() const { return parts_; }  ///< of a column
  [[nodiscard]] int stride() const { return lanes * parts_; }
  [[nodiscard]] Scalar* data() { return entries_.data(); }
  [[nodiscard]] const Scalar* data() const { return entries_.data(); }

  [[nodiscard]] EIGEN_ALWAYS_INLINE Scalar& operator()(int i, int j) { return data()[j * stride() + i]; }
  [[nodiscard]] EIGEN_ALWAYS_INLINE const Scalar& operator()(int i, int j) const { return data()[j * stride() + i]; }

  [[nodiscard]] static EIGEN_ALWAYS_INLINE Part load(const Scalar* from) {
    if constexpr (lanes == 1) {
      return *from;
    } else {
      Part part;
      std::memcpy(&part, from, sizeof part);
      return part;
    }
  }
  static EIGEN_ALWAYS_INLINE void store(const Part& part, Scalar* to) {
    if constexpr (lanes == 1) {
      *to = part;
    } else {
      std::memcpy(to, &part, sizeof part);
    }
  }

  [[nodiscard]] Matrix& entries() { return entries_; }  ///< with the zeros below
  [[nodiscard]] const Matrix& entries() const { return entries_; }
  [[nodiscard]] auto matrix() const { return entries_.topRows(size_); }

 private:
  int size_ = 0, parts_ = 0;
  Matrix entries_;
};

/// Largest size for the loops here.
inline constexpr int small_block = 16;

/// f(first part, their number as a constant) for a column in strips that stay in registers.
template <typename F>
EIGEN_ALWAYS_INLINE void for_each_strip(int first, int parts, F&& f) {
  for (; first + 8 <= parts; first += 8) f(first, std::integral_constant<int, 8>{});
  for (; first + 4 <= parts; first += 4) f(first, std::integral_constant<int, 4>{});
  switch (parts - first) {
    case 3:
      return f(first, std::integral_constant<int, 3>{});
    case 2:
      return f(first, std::integral_constant<int, 2>{});
    case 1:
      return f(first, std::integral_constant<int, 1>{});
    default:
      return;
  }
}

/// to = sum over k < count of column(k) factor(k), in the parts of one strip.
template <typename Scalar, int width, typename Column, typename Factor>
EIGEN_ALWAYS_INLINE void combine_columns(int first, std::integral_constant<int, width>, int from, int count,
                                         Column&& column, Factor&& factor, Scalar* to) {
  using Block = DynamicBlock<Scalar>;
  typename Block::Part sum[width];  // NOLINT(*-avoid-c-arrays): registers
  const auto part = [first](auto* start, int p) { return start + (first + p) * Block::lanes; };
  LIMPID_UNROLL
  for (int p = 0; p < width; ++p) sum[p] = Block::load(part(column(from), p)) * factor(from);
  for (int k = from + 1; k < count; ++k) {
    const Scalar* const start = column(k);
    const auto by = all_lanes<typename Block::Part>(factor(k));
    LIMPID_UNROLL
    for (int p = 0; p < width; ++p) sum[p] += Block::load(part(start, p)) * by;
  }
  LIMPID_UNROLL
  for (int p = 0; p < width; ++p) Block::store(sum[p], part(to, p));
}

/// to -= factor * column, parts from `first` on
template <typename Scalar>
EIGEN_ALWAYS_INLINE void subtract_column(int first, int parts, const Scalar* column, const Scalar& factor, Scalar* to) {
  using Block = DynamicBlock<Scalar>;
  const auto by = all_lanes<typename Block::Part>(factor);
  for (int p = first * Block::lanes; p < parts * Block::lanes; p += Block::lanes) {
    Block::store(Block::load(to + p) - Block::load(column + p) * by, to + p);
  }
}

/// Sum of products, parts from `first` on
template <typename Scalar>
[[nodiscard]] EIGEN_ALWAYS_INLINE Scalar product_of_columns(int first, int parts, const Scalar* a, const Scalar* b) {
  using Block = DynamicBlock<Scalar>;
  auto sum = all_lanes<typename Block::Part>(Scalar{0});
  for (int p = first * Block::lanes; p < parts * Block::lanes; p += Block::lanes) {
    sum += Block::load(a + p) * Block::load(b + p);
  }
  return sum_of_lanes(sum);
}

template <typename Scalar>
void set_scaled_identity(DynamicBlock<Scalar>& A, const Scalar& diagonal) {
  A.entries().setZero();
  for (int i = 0; i < A.rows(); ++i) A(i, i) = diagonal;
}
/// A += scale B
template <typename Scalar>
void add_scaled(DynamicBlock<Scalar>& A, const Scalar& scale, const DynamicBlock<Scalar>& B) {
  A.entries() += scale * B.entries();
}
/// A = own A + scale B
template <typename Scalar>
void scale_and_add(DynamicBlock<Scalar>& A, const Scalar& own, const Scalar& scale, const DynamicBlock<Scalar>& B) {
  A.entries() = own * A.entries() + scale * B.entries();
}

/// C = A B
template <typename Scalar>
void multiply(const DynamicBlock<Scalar>& A, const DynamicBlock<Scalar>& B, DynamicBlock<Scalar>& C) {
  const int n = A.rows();
  if (n > small_block) {
    C.entries().noalias() = A.entries() * B.matrix();
    return;
  }
  for_each_strip(0, A.parts(), [&](int first, auto width) {
    const auto column = [&](int k) { return &A(0, k); };
    for (int j = 0; j < n; ++j) {
      combine_columns<Scalar>(
          first, width, 0, n, column, [b = &B(0, j)](int k) { return b[k]; }, &C(0, j));
    }
  });
}
/// C = (A B' + B A') / 2, for symmetric A
template <typename Scalar>
void multiply_symmetrised(const DynamicBlock<Scalar>& A, const DynamicBlock<Scalar>& B, DynamicBlock<Scalar>& C) {
  const int n = A.rows();
  if (n > small_block) {
    C.entries().noalias() = A.entries() * B.matrix().transpose();
  } else {
    for_each_strip(0, A.parts(), [&](int first, auto width) {
      const auto column = [&](int k) { return &A(0, k); };
      for (int j = 0; j < n; ++j) {
        combine_columns<Scalar>(
            first, width, 0, n, column, [&](int k) { return B(j, k); }, &C(0, j));
      }
    });
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < j; ++i) C(i, j) = C(j, i) = (C(i, j) + C(j, i)) * (Scalar{1} / Scalar{2});
  }
}

/// tr(A B) of symmetric matrices
template <typename Scalar>
[[nodiscard]] Scalar inner_product_of(const DynamicBlock<Scalar>& A, const DynamicBlock<Scalar>& B) {
  return A.entries().cwiseProduct(B.entries()).sum();
}
/// tr(A B)
template <typename Scalar>
[[nodiscard]] Scalar trace_of_product(const DynamicBlock<Scalar>& A, const DynamicBlock<Scalar>& B) {
  Scalar sum{0};
  for (int j = 0; j < A.rows(); ++j) {
    Scalar here = A(j, j) * B(j, j);
    for (int i = 0; i < j; ++i) here += A(i, j) * B(j, i) + A(j, i) * B(i, j);
    sum += here;
  }
  return sum;
}

/// Makes it symmetric to the last bit.
template <typename Scalar>
void copy_lower_to_upper(DynamicBlock<Scalar>& A) {
  for (int j = 0; j < A.rows(); ++j) {
    for (int i = 0; i < j; ++i) A(i, j) = A(j, i);
  }
}

/// By A = L D L' and K = L^-1: A^-1 = K' D^-1 K. One matrix holds both, L D below the diagonal and K' above: the step
/// that takes a column off those to its right is the same for both.
template <typename Scalar>
[[nodiscard]] bool invert_small(const DynamicBlock<Scalar>& A, DynamicBlock<Scalar>& inverse) {
  const int n = A.rows(), parts = A.parts();
  constexpr auto order = static_cast<std::size_t>(small_block);
  const int stride = A.stride();
  alignas(32) std::array<Scalar, order * order> entries;
  std::copy(A.data(), A.data() + stride * n, entries.data());
  const auto column_of = [&entries, stride](int j) { return entries.data() + j * stride; };
  std::array<Scalar, order> reciprocal;
  for (int j = 0; j < n; ++j) {
    Scalar* const column = column_of(j);
    if (!(column[j] > Scalar{0})) return false;
    const Scalar by_pivot = reciprocal[static_cast<std::size_t>(j)] = Scalar{1} / column[j];
    for (int k = j + 1; k < n; ++k) {
      const Scalar multiple = column[k] * by_pivot;
      Scalar* const other = column_of(k);
      subtract_column(0, parts, column, multiple, other);
      other[j] = -multiple;
    }
    column[j] = Scalar{1};
    for (int i = j + 1; i < n; ++i) column[i] = Scalar{0};
  }
  for_each_strip(0, parts, [&](int first, auto width) {
    for (int j = 0; j < n; ++j) {
      const auto factor = [&](int k) { return column_of(k)[j] * reciprocal[static_cast<std::size_t>(k)]; };
      combine_columns<Scalar>(first, width, j, n, column_of, factor, &inverse(0, j));
    }
  });
  copy_lower_to_upper(inverse);
  return true;
}
/// False where A is not positive definite.
template <typename Scalar>
[[nodiscard]] bool invert(const DynamicBlock<Scalar>& A, DynamicBlock<Scalar>& inverse) {
  if (A.rows() <= small_block) return invert_small(A, inverse);
  const Eigen::LLT<typename DynamicBlock<Scalar>::Matrix> factor(A.matrix());
  if (factor.info() != Eigen::Success || !(factor.matrixLLT().diagonal().minCoeff() > Scalar{0})) return false;
  inverse.entries().setIdentity();
  auto solution = inverse.entries().topRows(A.rows());
  factor.solveInPlace(solution);
  copy_lower_to_upper(inverse);
  return true;
}

}  // namespace limpid::detail
