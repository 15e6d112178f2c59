// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/ball.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <concepts>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace limpid {

/// The names behind an Lmi's unknowns, shared by its expressions so that an error can say which variable it is about.
struct LmiNames {
  struct Variable {
    std::string name;
    int first = 0, count = 0;  ///< its unknowns
  };
  std::vector<Variable> variables;
  int unknowns = 0;

  [[nodiscard]] const std::string& of(int unknown) const {
    const auto behind = std::partition_point(variables.begin(), variables.end(),
                                             [unknown](const Variable& v) { return v.first + v.count <= unknown; });
    return behind->name;
  }
};

template <Real Scalar>
struct LmiInequality;
template <Real Scalar>
struct LmiEquation;

/// A matrix whose entries are affine in the unknowns of an Lmi: what variables, constant matrices and numbers turn
/// into.
///
/// Numbers and Eigen matrices convert to it. Factors are balls, so that data which were formed with rounding stay
/// inside what a certificate covers. A plain 0 takes the shape its place asks for; an expression of shape 1 x 1 times a
/// matrix scales the matrix.
///
/// Off line: allocates. Wrong shapes throw std::invalid_argument with the variables, the shape expected and the one
/// got.
template <Real Scalar = double>
class LmiExpression {
 public:
  using Factor = Ball<Scalar>;

  /// factor * (unknown, or 1 where it is `constant`) at (row, column).
  struct Term {
    int unknown, row, column;
    Factor factor;
  };
  static constexpr int constant = -1;

  template <typename Number>
  requires std::convertible_to<Number, Factor> LmiExpression(const Number& number)  // NOLINT(*-member-init): delegates
      : LmiExpression(nullptr, 1, 1) {                                              // NOLINT: implicit, as in P > 0
    if constexpr (std::is_arithmetic_v<Number>) {
      add(constant, 0, 0, Factor(static_cast<Scalar>(number)));
    } else {
      add(constant, 0, 0, Factor(number));
    }
  }

  template <typename Derived>
  LmiExpression(const Eigen::MatrixBase<Derived>& values)  // NOLINT: implicit, as in A * P
      : LmiExpression(nullptr, static_cast<int>(values.rows()), static_cast<int>(values.cols())) {
    const auto& evaluated = values.derived().eval();
    for (int i = 0; i < rows_; ++i) {
      for (int j = 0; j < columns_; ++j) add(constant, i, j, Factor(evaluated(i, j)));
    }
  }

  /// 0 of a shape.
  /// @throws std::invalid_argument  where there are fewer than 0 rows or columns
  LmiExpression(std::shared_ptr<const LmiNames> names, int rows, int columns)
      : names_{std::move(names)}, rows_{rows}, columns_{columns} {
    if (rows >= 0 && columns >= 0) return;
    throw std::invalid_argument("Lmi: expected rows and columns >= 0, got " + shape(rows, columns));
  }

  [[nodiscard]] int rows() const noexcept { return rows_; }
  [[nodiscard]] int columns() const noexcept { return columns_; }
  [[nodiscard]] const std::vector<Term>& terms() const noexcept { return terms_; }
  [[nodiscard]] const std::shared_ptr<const LmiNames>& names() const noexcept { return names_; }
  [[nodiscard]] bool is_zero() const noexcept { return terms_.empty(); }
  [[nodiscard]] bool is_constant() const noexcept {
    return std::all_of(terms_.begin(), terms_.end(), [](const Term& t) { return t.unknown == constant; });
  }

  /// "X, Y (2 x 4)": the variables and the shape, for errors.
  [[nodiscard]] std::string describe() const {
    std::vector<std::string> seen;
    for (const Term& term : terms_) {
      const std::string name = term.unknown == constant ? "constant" : names_->of(term.unknown);
      if (std::find(seen.begin(), seen.end(), name) == seen.end()) seen.push_back(name);
    }
    std::string text;
    for (const std::string& name : seen) text += (text.empty() ? "" : ", ") + name;
    return (text.empty() ? "0" : text) + " (" + shape(rows_, columns_) + ")";
  }

  /// Adds one term; zero factors are left out.
  /// @throws std::invalid_argument  where the factor is not finite, the place outside or the unknown none of its Lmi's
  void add(int unknown, int row, int column, const Factor& factor) {
    expect(unknown >= constant && unknown < (names_ ? names_->unknowns : 0), "Lmi: unknown", "one of its Lmi", unknown);
    expect_place(row, column, 1, 1);
    if (is_exactly(factor, 0)) return;
    if (!is_finite(factor.centre()) || !factor.bounded()) refuse(unknown, factor);
    terms_.push_back({unknown, row, column, factor});
  }

  /// Adds `part` with its first entry at (row, column).
  /// @throws std::invalid_argument  where it does not fit
  void add(const LmiExpression& part, int row, int column) {
    expect_place(row, column, part.rows_, part.columns_);
    join(part);
    for (const Term& term : part.terms_)
      terms_.push_back({term.unknown, row + term.row, column + term.column, term.factor});
  }

  LmiExpression& operator+=(const LmiExpression& other) {
    if (other.is_zero() && other.rows_ * other.columns_ == 1) return *this;
    if (is_zero() && rows_ * columns_ == 1) return *this = other;
    expect_shape("sum", rows_, columns_, other);
    add(other, 0, 0);
    return *this;
  }
  LmiExpression& operator-=(const LmiExpression& other) { return *this += -other; }

  [[nodiscard]] friend LmiExpression operator+(LmiExpression a, const LmiExpression& b) { return a += b; }
  [[nodiscard]] friend LmiExpression operator-(LmiExpression a, const LmiExpression& b) { return a -= b; }
  [[nodiscard]] friend LmiExpression operator-(LmiExpression a) {
    for (Term& term : a.terms_) term.factor = -term.factor;
    return a;
  }

  /// One side must be constant; a side of shape 1 x 1 scales the other.
  [[nodiscard]] friend LmiExpression operator*(const LmiExpression& a, const LmiExpression& b) {
    if (!a.is_constant() && !b.is_constant()) {
      throw std::invalid_argument("Lmi: product: expected a constant side, got " + a.describe() + " and " +
                                  b.describe());
    }
    if (a.rows_ * a.columns_ == 1) return scaled(b, a);
    if (b.rows_ * b.columns_ == 1) return scaled(a, b);
    b.expect_rows("product", a.columns_);
    LmiExpression product(nullptr, a.rows_, b.columns_);
    product.join(a);
    product.join(b);
    for (const Term& l : a.terms_) {
      for (const Term& r : b.terms_) {
        if (l.column != r.row) continue;
        product.add(std::max(l.unknown, r.unknown), l.row, r.column, multiplied(l.factor, r.factor));
      }
    }
    return product;
  }

  [[nodiscard]] friend LmiExpression transpose(LmiExpression a) {
    std::swap(a.rows_, a.columns_);
    for (Term& term : a.terms_) std::swap(term.row, term.column);
    return a;
  }

  [[nodiscard]] friend LmiExpression trace(const LmiExpression& a) {
    a.expect_shape("trace", a.rows_, a.rows_, a);
    LmiExpression sum(a.names_, 1, 1);
    for (const Term& term : a.terms_) {
      if (term.row == term.column) sum.terms_.push_back({term.unknown, 0, 0, term.factor});
    }
    return sum;
  }

  /// As inequalities of symmetric matrices, strict.
  [[nodiscard]] friend LmiInequality<Scalar> operator<(const LmiExpression& a, const LmiExpression& b) {
    return {b - a};
  }
  [[nodiscard]] friend LmiInequality<Scalar> operator>(const LmiExpression& a, const LmiExpression& b) {
    return {a - b};
  }
  /// Of shape 1 x 1, for Lmi::normalise.
  [[nodiscard]] friend LmiEquation<Scalar> operator==(const LmiExpression& a, const LmiExpression& b) {
    return {a - b};
  }

  /// Takes the names of `other`.
  /// @throws std::invalid_argument  where they are of another Lmi
  void join(const LmiExpression& other) {
    if (!names_) names_ = other.names_;
    if (other.names_ && other.names_ != names_) {
      throw std::invalid_argument("Lmi: expected variables of one Lmi, got " + describe() + " and " + other.describe());
    }
  }

  void expect_rows(const char* where, int rows) const {
    if (rows_ == rows) return;
    throw std::invalid_argument(std::string("Lmi: ") + where + ": expected " + std::to_string(rows) + " rows, got " +
                                describe());
  }
  void expect_shape(const char* where, int rows, int columns, const LmiExpression& other) const {
    if (other.rows_ == rows && other.columns_ == columns) return;
    throw std::invalid_argument(std::string("Lmi: ") + where + ": expected " + shape(rows, columns) +
                                (this == &other ? "" : " as of " + describe()) + ", got " + other.describe());
  }
  [[nodiscard]] static std::string shape(int rows, int columns) {
    return std::to_string(rows) + " x " + std::to_string(columns);
  }

 private:
  void expect_place(int row, int column, int rows, int columns) const {
    if (row >= 0 && column >= 0 && rows <= rows_ - row && columns <= columns_ - column) return;
    throw std::invalid_argument("Lmi: expected a place inside " + shape(rows_, columns_) + ", got " +
                                shape(rows, columns) + " at (" + std::to_string(row) + ", " + std::to_string(column) +
                                ")");
  }
  static bool is_exactly(const Factor& factor, int value) {
    return factor.centre() == Scalar(value) && factor.radius() == Scalar{0};
  }
  // Without a rounding where none happens.
  static Factor multiplied(const Factor& a, const Factor& b) {
    if (is_exactly(a, 1)) return b;
    if (is_exactly(b, 1)) return a;
    if (is_exactly(a, -1)) return -b;
    if (is_exactly(b, -1)) return -a;
    return a * b;
  }
  void refuse(int unknown, const Factor& factor) const {
    expect(false, "Lmi: coefficient of " + (unknown == constant ? std::string("a constant") : names_->of(unknown)),
           "finite", factor);
  }

  static LmiExpression scaled(const LmiExpression& a, const LmiExpression& number) {
    LmiExpression product(nullptr, a.rows_, a.columns_);
    product.join(a);
    product.join(number);
    product.terms_.reserve(a.terms_.size() * number.terms_.size());
    for (const Term& by : number.terms_) {
      for (const Term& term : a.terms_) {
        product.add(std::max(term.unknown, by.unknown), term.row, term.column, multiplied(by.factor, term.factor));
      }
    }
    return product;
  }

  std::shared_ptr<const LmiNames> names_;  // null for constants
  int rows_, columns_;
  std::vector<Term> terms_;  // in no order; several may share a place
};

/// expression > 0, as a symmetric matrix.
template <Real Scalar>
struct LmiInequality {
  LmiExpression<Scalar> expression;
};

/// expression = 0, of shape 1 x 1.
template <Real Scalar>
struct LmiEquation {
  LmiExpression<Scalar> expression;
};

}  // namespace limpid
