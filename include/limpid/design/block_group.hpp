// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/block_matrix.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <utility>

namespace limpid::detail {

/// `count` blocks of n x n, `width` matrices in each, that depend linearly on some of the variables:
///
///     S_k = F_k0 + sum_i x_i F_ki
///
/// The places that are not zero in any block are listed once for all; only the lower triangle. Storage is inside the
/// object.
template <Real Scalar, int n, int width_, int count, int variables>
class BlockGroup {
 public:
  static constexpr int width = width_;
  using E = Entry<Scalar, width_>;
  using Matrix = FixedBlock<E, n>;
  using Blocks = std::array<Matrix, static_cast<std::size_t>(count)>;
  using Vector = Eigen::Matrix<Scalar, variables, 1>;

  BlockGroup() { first_[0] = 0; }

  [[nodiscard]] static constexpr int size() { return n; }
  [[nodiscard]] static constexpr int dimension() { return n * width * count; }
  [[nodiscard]] static Blocks make() {
    Blocks blocks;
    return blocks;
  }

  /// Opens the coefficients of the next variable, in rising order; entries follow.
  void begin_variable(int variable) { active_[active_count_++] = variable; }
  void add_entry(int row, int col, const std::array<E, static_cast<std::size_t>(count)>& values) {
    values_[entry_count_] = values;
    places_[entry_count_++] = {row, col};
  }
  void end_variable() {
    if (entry_count_ == first_[active_count_ - 1]) {
      --active_count_;  // it is not in these blocks
    } else {
      first_[active_count_] = entry_count_;
    }
  }

  /// S = F(x); there is no constant part.
  void apply(const Vector& x, Blocks& S, bool /*with_constant*/) const {
    for (std::size_t k = 0; k < S.size(); ++k) {
      set_scaled_identity(S[k], Scalar{0});
      for (std::size_t a = 0; a < active_count_; ++a) {
        const Scalar& factor = x[active_[a]];
        for (std::size_t e = first_[a]; e < first_[a + 1]; ++e) {
          S[k](places_[e].row, places_[e].col) += values_[e][k] * factor;
        }
      }
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < i; ++j) S[k](j, i) = S[k](i, j);
      }
    }
  }

  /// sum_i += <F_i, W>, W symmetric
  void add_adjoint(const Blocks& W, Vector& sum) const {
    for (std::size_t a = 0; a < active_count_; ++a) {
      E total = all_lanes<E>(Scalar{0});
      for (std::size_t k = 0; k < W.size(); ++k) {
        for (std::size_t e = first_[a]; e < first_[a + 1]; ++e) {
          const Place& at = places_[e];
          const Scalar times = at.row == at.col ? Scalar{1} : Scalar{2};
          total += values_[e][k] * W[k](at.row, at.col) * times;
        }
      }
      sum[active_[a]] += sum_of_lanes(total);
    }
  }

  /// <F_0, W>
  [[nodiscard]] static Scalar constant_part(const Blocks&) { return Scalar{0}; }

  /// M_ij += <F_i, Z F_j S^-1>, the lower triangle.
  template <typename System>
  void add_schur(const Blocks& Z, const Blocks& S_inverse, System& M) const {
    constexpr auto columns = std::make_index_sequence<static_cast<std::size_t>(n)>{};
    Blocks U;
    for (std::size_t a = 0; a < active_count_; ++a) {
      const RowsOf rows = rows_of(a);
      for (std::size_t k = 0; k < Z.size(); ++k) multiply_coefficient(k, rows, Z[k], S_inverse[k], U[k], columns);
      for (std::size_t b = 0; b <= a; ++b) {
        M(active_[a], active_[b]) += sum_of_lanes(weighed_sum(b, U, std::make_index_sequence<std::size_t{count}>{}));
      }
    }
  }

 private:
  struct Place {
    int row, col;
  };
  static constexpr std::size_t order = static_cast<std::size_t>(n);
  static constexpr std::size_t most_active = static_cast<std::size_t>(variables);
  static constexpr std::size_t most_entries = most_active * (order * (order + 1) / 2);

  // Entries of F_a with their mirror images, by rows.
  struct RowsOf {
    struct Term {
      std::size_t col, entry;
    };
    std::array<Term, order * order> terms;
    std::array<std::size_t, order> row;        // those that are not zero
    std::array<std::size_t, order + 1> first;  // term of each, and one past the last
    std::size_t used = 0;
  };
  [[nodiscard]] RowsOf rows_of(std::size_t a) const {
    RowsOf rows;
    std::size_t size = 0;
    for (int r = 0; r < n; ++r) {
      rows.first[rows.used] = size;
      for (std::size_t e = first_[a]; e < first_[a + 1]; ++e) {
        const Place& at = places_[e];
        if (at.row == r) rows.terms[size++] = {static_cast<std::size_t>(at.col), e};
        if (at.col == r && at.row != r) rows.terms[size++] = {static_cast<std::size_t>(at.row), e};
      }
      if (size != rows.first[rows.used]) rows.row[rows.used++] = static_cast<std::size_t>(r);
    }
    rows.first[rows.used] = size;
    return rows;
  }

  // <F_b, U>, the blocks' sums side by side.
  template <std::size_t... k>
  [[nodiscard]] EIGEN_ALWAYS_INLINE E weighed_sum(std::size_t b, const Blocks& U, std::index_sequence<k...>) const {
    std::array<E, sizeof...(k)> sum{((void)k, E{})...};
    for (std::size_t e = first_[b]; e < first_[b + 1]; ++e) {
      const auto at = static_cast<std::size_t>(places_[e].row * n + places_[e].col);
      ((sum[k] += values_[e][k] * U[k].entries[at]), ...);
    }
    return (sum[k] + ...);
  }

  // Of U = Z F_a S^-1 below the diagonal U_rc + U_cr, on it U_rr: what an entry of a symmetric matrix is weighed with.
  // A row of sums has to stay in registers: its columns j are known to the compiler.
  template <std::size_t... j>
  [[gnu::noinline]] void multiply_coefficient(std::size_t k, const RowsOf& rows, const Matrix& Z,
                                              const Matrix& S_inverse, Matrix& U, std::index_sequence<j...>) const {
    Matrix T;  // rows of F_a S^-1 that are not zero
    for (std::size_t r = 0; r < rows.used; ++r) {
      std::array<E, sizeof...(j)> sum{((void)j, E{})...};
      for (std::size_t t = rows.first[r]; t < rows.first[r + 1]; ++t) {
        const E value = values_[rows.terms[t].entry][k];
        const E* const row = &S_inverse.entries[rows.terms[t].col * sizeof...(j)];
        ((sum[j] += value * row[j]), ...);
      }
      ((T.entries[r * sizeof...(j) + j] = sum[j]), ...);
    }
    for (std::size_t i = 0; i < sizeof...(j); ++i) {
      std::array<E, sizeof...(j)> sum{((void)j, E{})...};
      for (std::size_t r = 0; r < rows.used; ++r) {
        const E factor = Z.entries[i * sizeof...(j) + rows.row[r]];
        const E* const row = &T.entries[r * sizeof...(j)];
        ((sum[j] += factor * row[j]), ...);
      }
      ((U.entries[i * sizeof...(j) + j] = sum[j]), ...);
    }
    LIMPID_UNROLL
    for (int i = 0; i < n; ++i) {
      LIMPID_UNROLL
      for (int c = 0; c < i; ++c) U(i, c) += U(c, i);
    }
  }

  std::size_t active_count_ = 0, entry_count_ = 0;
  std::array<int, most_active> active_;             // variables that these blocks depend on, rising
  std::array<std::size_t, most_active + 1> first_;  // entry of each, and one past the last
  std::array<Place, most_entries> places_;
  std::array<std::array<E, static_cast<std::size_t>(count)>, most_entries> values_;  // of each entry, in each block
};

}  // namespace limpid::detail
