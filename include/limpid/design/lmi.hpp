// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/lmi_block.hpp>
#include <limpid/design/lmi_expression.hpp>
#include <limpid/design/lmi_problem.hpp>
#include <limpid/design/lmi_result.hpp>
#include <limpid/design/lmi_solver.hpp>

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace limpid {

/// Linear matrix inequalities, written as in a paper:
///
///     Lmi lmi;
///     const auto P = lmi.symmetric("P", 2);
///     lmi.require(A.transpose() * P + P * A < 0);
///     lmi.require(P > 0);
///     const auto result = lmi.solve();      // result.verdict, result[P], ...
///
/// For dense problems of up to about 100 unknowns and blocks of 40. The answer is the same on every run. Hard data do
/// not throw: the verdict is then undecided, with the reason. Data that are not finite, and shapes that do not fit, do.
///
/// Off line: allocates. One Lmi may be solved again and again, and grow in between.
template <Real Scalar = double>
class Lmi {
 public:
  using Expression = LmiExpression<Scalar>;
  using Settings = LmiSettings<Scalar>;

  explicit Lmi(const Settings& settings = {}) : settings_{settings} { settings.check(); }
  Lmi(Lmi&&) noexcept = default;
  Lmi& operator=(Lmi&&) noexcept = default;
  Lmi(const Lmi&) = delete;  // two that grow apart would share their unknowns' numbers
  Lmi& operator=(const Lmi&) = delete;
  ~Lmi() = default;

  static constexpr int most_unknowns = 10'000;

  /// An unknown n x n matrix, equal to its transpose.
  /// @throws std::invalid_argument  where n is not > 0, or there would be more than `most_unknowns`
  [[nodiscard]] Expression symmetric(std::string name, int n) {
    int unknown = begin(std::move(name), n, n, Count{n} * (Count{n} + 1) / 2);
    Expression P(names_, n, n);
    for (int j = 0; j < n; ++j) {
      for (int i = j; i < n; ++i, ++unknown) {
        P.add(unknown, i, j, one());
        if (i != j) P.add(unknown, j, i, one());
      }
    }
    return P;
  }

  /// An unknown matrix of any shape.
  [[nodiscard]] Expression full(std::string name, int rows, int columns) {
    int unknown = begin(std::move(name), rows, columns, Count{rows} * Count{columns});
    Expression X(names_, rows, columns);
    for (int j = 0; j < columns; ++j) {
      for (int i = 0; i < rows; ++i) X.add(unknown++, i, j, one());
    }
    return X;
  }

  /// An unknown number.
  [[nodiscard]] Expression scalar(std::string name) { return full(std::move(name), 1, 1); }

  /// @throws std::invalid_argument  where the matrix is empty or not symmetric, or of another Lmi's variables
  void require(const LmiInequality<Scalar>& inequality) {
    own(inequality.expression);
    inequality.expression.expect_shape("inequality", inequality.expression.rows(), inequality.expression.rows(),
                                       inequality.expression);
    if (inequality.expression.rows() == 0) {
      throw std::invalid_argument("Lmi: inequality: expected rows and columns > 0, got " +
                                  inequality.expression.describe());
    }
    problem_.blocks.push_back({inequality.expression.rows(), detail::lower_triangle(inequality.expression)});
  }

  /// One equation of numbers, as trace(P) == 1: makes a margin comparable, where every multiple of a solution is one.
  /// @throws std::invalid_argument  where it is not 1 x 1, holds no variable, or there is one already
  void normalise(const LmiEquation<Scalar>& equation) {
    if (problem_.has_equation) throw std::invalid_argument("Lmi: normalise: expected one equation, got a second");
    problem_.equation = linear("normalise", equation.expression);
    if (equation.expression.is_constant()) {
      throw std::invalid_argument("Lmi: normalise: expected a variable, got " + equation.expression.describe());
    }
    problem_.has_equation = true;
  }

  /// Asks for the solution with the largest objective, instead of any.
  void maximise(const Expression& objective) {
    problem_.objective = linear("maximise", objective);
    goal_ = LmiGoal::objective;
    sign_ = Scalar{1};
  }
  void minimise(const Expression& objective) {
    maximise(-objective);
    sign_ = Scalar{-1};
  }
  /// Asks for the largest t with every inequality, as a matrix, >= t I; where every multiple of a solution is one this
  /// needs an equation.
  void maximise_margin() { goal_ = LmiGoal::margin; }

  /// @throws std::invalid_argument  where there is no inequality
  [[nodiscard]] LmiResult<Scalar> solve() const {
    expect(!problem_.blocks.empty(), "Lmi: inequalities", "one or more", problem_.blocks.size());
    LmiResult<Scalar> result = detail::solve_lmi(problem_, goal_, settings_);
    if (sign_ < Scalar{0}) {
      result.objective = -result.objective;
      result.objective_bound = -result.objective_bound;
    }
    return result;
  }

  /// What the certificates are about.
  [[nodiscard]] const LmiProblem<Scalar>& problem() const noexcept { return problem_; }

 private:
  static Ball<Scalar> one() { return Ball<Scalar>(Scalar{1}); }

  using Count = long long;  // of products of two numbers of rows

  int begin(std::string name, int rows, int columns, Count count) {
    if (rows <= 0 || columns <= 0) {
      throw std::invalid_argument("Lmi: " + name + ": expected rows and columns > 0, got " +
                                  Expression::shape(rows, columns));
    }
    const int first = names_->unknowns;
    if (count > most_unknowns - first) {
      throw std::invalid_argument("Lmi: " + name + ": expected at most " + std::to_string(most_unknowns) +
                                  " unknowns in all, got " + Expression::shape(rows, columns) + " after " +
                                  std::to_string(first));
    }
    names_->variables.push_back({std::move(name), first, static_cast<int>(count)});
    problem_.unknowns = names_->unknowns += static_cast<int>(count);
    return first;
  }

  void own(const Expression& expression) const {
    if (!expression.names() || expression.names() == names_) return;
    throw std::invalid_argument("Lmi: expected variables of this Lmi, got " + expression.describe());
  }

  [[nodiscard]] std::vector<typename Expression::Term> linear(const char* where, const Expression& expression) const {
    own(expression);
    expression.expect_shape(where, 1, 1, expression);
    auto terms = expression.terms();
    detail::merge_terms(terms);
    return terms;
  }

  Settings settings_;
  std::shared_ptr<LmiNames> names_ = std::make_shared<LmiNames>();
  LmiProblem<Scalar> problem_;
  LmiGoal goal_ = LmiGoal::any;
  Scalar sign_{1};  // of the objective as asked for
};

}  // namespace limpid
