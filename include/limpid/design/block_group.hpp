// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/block_matrix.hpp>
#include <limpid/design/coefficient_product.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace limpid::detail {

/// `count` blocks of n x n, `width` matrices in each, that depend linearly on some of the variables:
///
///     S_k = F_k0 + sum_i x_i F_ki
///
/// The places that are not zero in any block are listed once for all; only the lower triangle. Storage is inside the
/// object; where n is dynamic there is one block of one matrix, and vectors hold it.
template <Real Scalar, int n, int width_, int count, int variables>
class BlockGroup {
 public:
  static constexpr bool dynamic = n == Eigen::Dynamic;
  static_assert(!dynamic || (width_ == 1 && count == 1), "BlockGroup: a group of dynamic size is one matrix");

  static constexpr int width = width_;
  using E = Entry<Scalar, width_>;
  using Matrix = Block<E, n>;
  using Blocks = std::array<Matrix, static_cast<std::size_t>(count)>;
  using Vector = Eigen::Matrix<Scalar, dynamic ? Eigen::Dynamic : variables, 1>;

  BlockGroup() : size_{n} { first_push(0); }
  explicit BlockGroup(int size) requires(dynamic) : size_{size} {
    first_push(0);
    constant_[0].setZero(size, size);
  }

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int dimension() const { return size_ * width * count; }
  [[nodiscard]] Blocks make() const {
    Blocks blocks;
    if constexpr (dynamic) blocks[0].resize(size_, size_);
    return blocks;
  }

  /// Opens the coefficients of the next variable, in rising order; entries follow.
  void begin_variable(int variable) { push(active_, active_count_, variable); }
  void add_entry(int row, int col, const std::array<E, static_cast<std::size_t>(count)>& values) {
    std::size_t where = entry_count_;
    push(values_, where, values);
    push(places_, entry_count_, Place{row, col});
  }
  void end_variable() {
    if (places_end() == first_[active_count_ - 1]) {
      --active_count_;  // it is not in these blocks
      if constexpr (dynamic) active_.pop_back();
    } else {
      first_push(places_end());
    }
  }
  void add_constant(int row, int col, const Scalar& value) requires(dynamic) {
    constant_[0](row, col) += value;
    if (row != col) constant_[0](col, row) += value;
  }

  /// S = F(x), with the constant part or without.
  void apply(const Vector& x, Blocks& S, [[maybe_unused]] bool with_constant) const {
    for (std::size_t k = 0; k < S.size(); ++k) {
      set_scaled_identity(S[k], Scalar{0});
      if constexpr (dynamic) {
        if (with_constant) S[k] = constant_[k];
      }
      for (std::size_t a = 0; a < active_count_; ++a) {
        const Scalar& factor = x[active_[a]];
        for (std::size_t e = first_[a]; e < first_[a + 1]; ++e) {
          S[k](places_[e].row, places_[e].col) += values_[e][k] * factor;
        }
      }
      for (int i = 0; i < size_; ++i) {
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
  [[nodiscard]] Scalar constant_part(const Blocks& W) const {
    if constexpr (dynamic) {
      return trace_of_product(constant_[0], W[0]);
    } else {
      return Scalar{0};
    }
  }

  /// M_ij += <F_i, Z F_j S^-1>, the lower triangle.
  template <typename System>
  void add_schur(const Blocks& Z, const Blocks& S_inverse, System& M) const {
    if constexpr (dynamic) {
      add_schur_dynamic(Z[0], S_inverse[0], M);
    } else {
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
  }

 private:
  struct Place {
    int row, col;
  };
  static constexpr std::size_t most_active = dynamic ? 0 : static_cast<std::size_t>(variables);
  static constexpr std::size_t most_entries = dynamic ? 0 : most_active * (static_cast<std::size_t>(n) * (n + 1) / 2);
  template <typename T, std::size_t capacity>
  using List = std::conditional_t<dynamic, std::vector<T>, std::array<T, capacity>>;

  template <typename Container, typename T>
  static void push(Container& list, std::size_t& size, const T& value) {
    if constexpr (dynamic) {
      list.push_back(value);
    } else {
      list[size] = value;
    }
    ++size;
  }
  void first_push(std::size_t value) {
    std::size_t where = active_count_;
    push(first_, where, value);
  }
  [[nodiscard]] std::size_t places_end() const { return entry_count_; }

  // Entries of F_a with their mirror images, by rows.
  struct RowsOf {
    struct Term {
      std::size_t col, entry;
    };
    std::array<Term, static_cast<std::size_t>(n < 0 ? 0 : n * n)> terms;
    std::array<std::size_t, static_cast<std::size_t>(n < 0 ? 0 : n)> row;        // those that are not zero
    std::array<std::size_t, static_cast<std::size_t>(n < 0 ? 0 : n) + 1> first;  // term of each, and one past the last
    std::size_t used = 0;
  };
  [[nodiscard]] RowsOf rows_of(std::size_t a) const requires(!dynamic) {
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
  [[nodiscard]] EIGEN_ALWAYS_INLINE E weighed_sum(std::size_t b, const Blocks& U, std::index_sequence<k...>) const
      requires(!dynamic) {
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
                                              const Matrix& S_inverse, Matrix& U, std::index_sequence<j...>) const
      requires(!dynamic) {
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

  template <typename System>
  void add_schur_dynamic(const Matrix& Z, const Matrix& S_inverse, System& M) const requires(dynamic) {
    if (size_ <= small_block) {
      SmallCoefficientProduct<Scalar> product(Z, S_inverse);
      add_schur_by(product, M);
    } else {
      LargeCoefficientProduct<Scalar> product(Z, S_inverse);
      add_schur_by(product, M);
    }
  }
  template <typename Product, typename System>
  void add_schur_by(Product& product, System& M) const requires(dynamic) {
    for (std::size_t a = 0; a < active_count_; ++a) {
      product.begin();
      for (std::size_t e = first_[a]; e < first_[a + 1]; ++e) {
        product.add_row(places_[e].row, places_[e].col, values_[e][0]);
        if (places_[e].row != places_[e].col) product.add_row(places_[e].col, places_[e].row, values_[e][0]);
      }
      product.multiply();
      for (std::size_t b = 0; b <= a; ++b) {
        Scalar sum{0};
        for (std::size_t e = first_[b]; e < first_[b + 1]; ++e) {
          sum += values_[e][0] * product(places_[e].row, places_[e].col);
        }
        M(active_[a], active_[b]) += sum;
      }
    }
  }

  int size_;
  std::size_t active_count_ = 0, entry_count_ = 0;
  List<int, most_active> active_;             // variables that these blocks depend on, rising
  List<std::size_t, most_active + 1> first_;  // entry of each, and one past the last
  List<Place, most_entries> places_;
  List<std::array<E, static_cast<std::size_t>(count)>, most_entries> values_;  // of each entry, in each block
  std::array<std::conditional_t<dynamic, Matrix, char>, static_cast<std::size_t>(count)> constant_{};
};

}  // namespace limpid::detail
