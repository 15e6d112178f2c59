// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/coefficient_product.hpp>
#include <limpid/design/dynamic_block.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace limpid::detail {

/// One block of a size known at run time, S = F_0 + sum_i x_i F_i: the dynamic counterpart of BlockGroup.
///
/// Coefficients are sparse. Each place (row, column) of the lower triangle that any of them uses has a number.
template <Real Scalar>
class DynamicGroup {
 public:
  static constexpr int width = 1;
  using E = Scalar;
  using Matrix = DynamicBlock<Scalar>;
  using Blocks = std::array<Matrix, 1>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  explicit DynamicGroup(int size) : zero_(size), numbers_(static_cast<std::size_t>(size * size), -1) {}

  [[nodiscard]] int size() const { return zero_.rows(); }
  [[nodiscard]] int dimension() const { return size(); }
  [[nodiscard]] Blocks make() const { return {Matrix(size())}; }

  /// Opens the coefficients of the next variable, in rising order; entries follow, of the lower triangle.
  void begin_variable(int variable) { variables_.push_back({variable, entries_.size()}); }
  void add_entry(int row, int col, const std::array<Scalar, 1>& value) {
    int& number = numbers_[static_cast<std::size_t>(row * size() + col)];
    if (number < 0) {
      number = static_cast<int>(places_.size());
      places_.push_back(
          {row, col, col * zero_.stride() + row, row * zero_.stride() + col, Products::index(row, col, zero_.parts())});
    }
    const Scalar half = row == col ? Scalar(value[0] / Scalar{2}) : value[0];
    entries_.push_back({number, places_[static_cast<std::size_t>(number)].below, value[0], half});
  }
  void end_variable() {
    if (variables_.back().first == entries_.size()) variables_.pop_back();  // it is not in this block
  }
  void add_constant(int row, int col, const Scalar& value) {
    zero_(row, col) += value;
    if (row != col) zero_(col, row) += value;
  }

  /// S = F(x), with the constant part or without.
  void apply(const Vector& x, Blocks& blocks, bool with_constant) const {
    Matrix& S = blocks[0];
    if (with_constant) {
      S = zero_;
    } else {
      S.entries().setZero();
    }
    Scalar* const to = S.data();
    for (std::size_t a = 0; a < variables_.size(); ++a) {
      const Scalar factor = x[variables_[a].number];
      for (std::size_t e = variables_[a].first; e < end_of(a); ++e) to[entries_[e].below] += entries_[e].value * factor;
    }
    for (const Place& place : places_) to[place.above] = to[place.below];
  }

  /// sum_i += <F_i, W>, W symmetric
  void add_adjoint(const Blocks& W, Vector& sum) const {
    const Scalar* const from = W[0].data();
    for (std::size_t a = 0; a < variables_.size(); ++a) {
      Scalar total{0};
      for (std::size_t e = variables_[a].first; e < end_of(a); ++e) total += entries_[e].half * from[entries_[e].below];
      sum[variables_[a].number] += Scalar{2} * total;
    }
  }

  /// <F_0, W>
  [[nodiscard]] Scalar constant_part(const Blocks& W) const { return inner_product_of(zero_, W[0]); }

  /// M_ij += <F_i, Z F_j S^-1>, the lower triangle.
  template <typename System>
  void add_schur(const Blocks& Z, const Blocks& S_inverse, System& M) const {
    if (size() <= small_block && places_.size() < 4 * variables_.size()) {
      add_schur_by_places(Z[0], S_inverse[0], M);
    } else {
      add_schur_by_coefficients(Z[0], S_inverse[0], M);
    }
  }

 private:
  static constexpr int lanes = Matrix::lanes;
  using Products = PlaceProducts<Scalar>;
  struct Place {
    int row, col;
    int below, above;  // where it and its mirror image are stored
    int in_products;   // and of PlaceProducts
  };
  struct Entry {
    int place, below;
    Scalar value, half;  // half: of what is on the diagonal, where its place counts twice
  };
  struct Variable {
    int number;
    std::size_t first;  // of its entries
  };
  [[nodiscard]] std::size_t end_of(std::size_t a) const {
    return a + 1 < variables_.size() ? variables_[a + 1].first : entries_.size();
  }

  // to = sum over the entries of F_a of what their places have in `columns`.
  void combine_entries(std::size_t a, int first_part, int parts, const Scalar* columns, int stride, Scalar* to) const {
    const Entry* const entry = entries_.data() + variables_[a].first;
    const int count = static_cast<int>(end_of(a) - variables_[a].first);
    for_each_strip(first_part, parts, [&](int first, auto strip) {
      const auto column = [&](int e) { return columns + entry[e].place * stride; };
      combine_columns<Scalar>(
          first, strip, 0, count, column, [entry](int e) { return entry[e].half; }, to);
    });
  }
  // U_a = Z F_a S^-1 for each variable a, put together from what its places contribute; then <F_b, U_a> for all a.
  template <typename System>
  void add_schur_by_places(const Matrix& Z, const Matrix& S_inverse, System& M) const {
    const int count = static_cast<int>(variables_.size()), parts = (count + lanes - 1) / lanes;
    const int stride = parts * lanes, length = Products::size(size(), Z.parts());
    const auto places = static_cast<int>(places_.size());
    // Of each place its products and (U_a)_rc + (U_a)_cr for all a; the latter's sums; one variable's U_a.
    Scalar* const products = M.workspace((length + stride) * (places + 1));
    Scalar *const U = products + length * places, *const sums = U + stride * places, *const sum = sums + stride;
    for (int p = 0; p < places; ++p) {
      const Place& at = places_[static_cast<std::size_t>(p)];
      Products::write(Z, S_inverse, at.row, at.col, products + p * length);
      std::fill(U + p * stride + count, U + (p + 1) * stride, Scalar{0});
    }
    for (std::size_t a = 0; a < variables_.size(); ++a) {
      combine_entries(a, 0, length / lanes, products, length, sum);
      Scalar* to = U + a;
      for (const Place& at : places_) {
        *to = sum[at.in_products];
        to += stride;
      }
    }
    for (int b = 0; b < count; ++b) {
      combine_entries(static_cast<std::size_t>(b), b / lanes, parts, U, stride, sums);
      const int column = variables_[static_cast<std::size_t>(b)].number;
      Scalar* const to = &M(0, column);
      if (variables_.back().number - column == count - 1 - b) {  // they follow one another
        for (int a = b; a < count; ++a) to[column + a - b] += sums[a];
      } else {
        for (int a = b; a < count; ++a) to[variables_[static_cast<std::size_t>(a)].number] += sums[a];
      }
    }
  }
  // The same with one U_a at a time, from the whole coefficient.
  template <typename System>
  void add_schur_by_coefficients(const Matrix& Z, const Matrix& S_inverse, System& M) const {
    CoefficientProduct<Scalar> product(Z, S_inverse);
    for (std::size_t a = 0; a < variables_.size(); ++a) {
      product.begin();
      for (std::size_t e = variables_[a].first; e < end_of(a); ++e) {
        const Place& at = places_[static_cast<std::size_t>(entries_[e].place)];
        product.add_row(at.row, at.col, entries_[e].value);
        if (at.row != at.col) product.add_row(at.col, at.row, entries_[e].value);
      }
      product.multiply();
      for (std::size_t b = 0; b <= a; ++b) {
        Scalar sum{0};
        for (std::size_t e = variables_[b].first; e < end_of(b); ++e) {
          const Place& at = places_[static_cast<std::size_t>(entries_[e].place)];
          sum += entries_[e].half * product(at.row, at.col);
        }
        M(variables_[a].number, variables_[b].number) += sum;
      }
    }
  }

  Matrix zero_;               // F_0
  std::vector<int> numbers_;  // of places, by row and column; -1 where none
  std::vector<Place> places_;
  std::vector<Entry> entries_;       // by variable
  std::vector<Variable> variables_;  // on which this block depends, rising
};

}  // namespace limpid::detail
