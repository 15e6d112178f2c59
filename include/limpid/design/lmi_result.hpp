// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/lmi_dual_certificate.hpp>
#include <limpid/design/lmi_expression.hpp>

#include <Eigen/Core>

#include <limits>
#include <string>
#include <vector>

namespace limpid {

/// What became of an Lmi. Feasible and infeasible are proved: see lmi_certificate.hpp and lmi_dual_certificate.hpp.
template <Real Scalar = double>
struct LmiResult {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  Verdict verdict = Verdict::undecided;
  std::string reason;  ///< how the verdict came about; where undecided why
  int iterations = 0;  ///< of the solver, all its runs together

  /// Where feasible: every inequality, as a matrix, is > margin I there; proved, >= 0.
  Scalar margin = std::numeric_limits<Scalar>::quiet_NaN();
  /// Of the largest margin, where that was asked for; proved; infinite where no bound was.
  Scalar margin_bound = std::numeric_limits<Scalar>::infinity();
  /// The objective at the values. That these are a solution is proved, so that the best is no worse; the number itself
  /// is evaluated in Scalar, and rounded.
  Scalar objective = std::numeric_limits<Scalar>::quiet_NaN();
  /// What no solution exceeds (for minimise: falls below); proved; infinite where no bound was.
  Scalar objective_bound = std::numeric_limits<Scalar>::quiet_NaN();

  Vector unknowns;                       ///< where feasible: the certificate; empty otherwise
  LmiMultipliers<Scalar> multipliers{};  ///< where infeasible: the certificate, sum tr Z_j = 1

  [[nodiscard]] bool feasible() const noexcept { return verdict == Verdict::feasible; }
  [[nodiscard]] bool infeasible() const noexcept { return verdict == Verdict::infeasible; }

  /// The value of a variable, or of anything made of variables; NaN where there are no values.
  /// @throws std::invalid_argument  where a variable was not yet there when the Lmi was solved
  [[nodiscard]] Matrix operator[](const LmiExpression<Scalar>& expression) const {
    Matrix value = Matrix::Zero(expression.rows(), expression.columns());
    if (unknowns.size() == 0) value.setConstant(std::numeric_limits<Scalar>::quiet_NaN());
    if (unknowns.size() == 0) return value;
    for (const auto& term : expression.terms()) {
      const bool constant = term.unknown == LmiExpression<Scalar>::constant;
      expect(constant || term.unknown < unknowns.size(), "LmiResult: expression", "of the Lmi as it was solved",
             term.unknown);
      value(term.row, term.column) += term.factor.centre() * (constant ? Scalar{1} : unknowns[term.unknown]);
    }
    return value;
  }
  /// The same, of what is 1 x 1.
  [[nodiscard]] Scalar number(const LmiExpression<Scalar>& expression) const { return (*this)[expression](0, 0); }
};

}  // namespace limpid
