// SPDX-License-Identifier: MIT
#include "design/lmi_cases.hpp"
#include "design_instances.hpp"

#include <limpid/design/lmi.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>

#include <limits>
#include <stdexcept>

using Eigen::Matrix2d;
using limpid::block;
using limpid::Lmi;
using limpid::symmetric_block;
using limpid::test::matrix;

namespace {

Eigen::MatrixXd terms(const limpid::LmiExpression<>& expression, const Eigen::VectorXd& x) {
  limpid::LmiResult<> result;
  result.unknowns = x;
  return result[expression];
}

}  // namespace

TEST_CASE("expressions are what their matrices are") {
  Lmi<> lmi;
  const auto P = lmi.symmetric("P", 2), X = lmi.full("X", 2, 2), g = lmi.scalar("g");
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(8, 1, 8);
  const Matrix2d P0 = matrix(1, 2, 2, 3), X0 = matrix(4, 6, 5, 7), A = matrix(1, -2, 3, 0.5);
  CHECK(terms(P, x) == P0);
  CHECK(terms(X, x) == X0);
  CHECK(terms(transpose(X), x) == X0.transpose());
  CHECK(terms(A * P + P * A.transpose(), x) == A * P0 + P0 * A.transpose());
  CHECK(terms(2 * X - P, x) == 2 * X0 - P0);
  CHECK(terms(g * A, x) == 8 * A);
  CHECK(terms(A * g, x) == 8 * A);
  CHECK(terms(trace(X), x)(0, 0) == 11);
  CHECK(terms(limpid::identity(2) - X, x) == Matrix2d::Identity() - X0);
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(5, 5);
  whole << P0, X0.transpose(), Eigen::Vector2d::Zero(), X0, -P0, Eigen::Vector2d(1, 2), 0, 0, 1, 2, 8;
  const auto row = Eigen::RowVector2d(1, 2);
  CHECK(terms(symmetric_block({{P}, {X, -P}, {0, row, g}}), x) == whole);
  CHECK(terms(block({{P, transpose(X), 0}, {X, -P, row.transpose()}, {0, row, g}}), x) == whole);
}

TEST_CASE("what does not fit is refused, and named") {
  Lmi<> lmi, other;
  const auto P = lmi.symmetric("P", 2), X = lmi.full("X", 2, 3);
  const auto foreign = other.symmetric("Q", 2);
  CHECK_THROWS_WITH_AS((void)(P * P), "Lmi: product: expected a constant side, got P (2 x 2) and P (2 x 2)",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)(P + X), "Lmi: sum: expected 2 x 2 as of P (2 x 2), got X (2 x 3)", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)(Eigen::Matrix3d::Identity() * P), "Lmi: product: expected 3 rows, got P (2 x 2)",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)trace(X), "Lmi: trace: expected 2 x 2, got X (2 x 3)", std::invalid_argument);
  CHECK_THROWS_WITH_AS(lmi.require(X > 0), "Lmi: inequality: expected 2 x 2, got X (2 x 3)", std::invalid_argument);
  CHECK_THROWS_WITH_AS(lmi.require(matrix(0, 1, 0, 0) * P > 0),
                       "Lmi: inequality: expected a symmetric matrix, got P (2 x 2)", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)block({{P, X}, {X, P}}),
                       "Lmi: block: expected 2 columns in block row 2 and column 1, got X (2 x 3)",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)symmetric_block({{P}, {P}}), "Lmi: block: expected 2 entries in block row 2, got 1",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)(P + foreign), "Lmi: expected variables of one Lmi, got P (2 x 2) and Q (2 x 2)",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(lmi.require(foreign > 0), "Lmi: expected variables of this Lmi, got Q (2 x 2)",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)lmi.symmetric("R", 0), "Lmi: R: expected rows and columns > 0, got 0 x 0",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(lmi.normalise(P == 1), "Lmi: sum: expected 2 x 2 as of P (2 x 2), got constant (1 x 1)",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)Lmi<>({.iterations = 0}), "Lmi: iterations: expected > 0, got 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)Lmi<>().solve(), "Lmi: inequalities: expected one or more, got 0", std::invalid_argument);
}

TEST_CASE("data that are not finite are refused") {
  Lmi<> lmi;
  const auto P = lmi.symmetric("P", 2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS((void)(matrix(nan, 0, 0, 1) * P), std::invalid_argument);
  CHECK_THROWS_AS((void)(P > nan), std::invalid_argument);
  CHECK_THROWS_AS((void)(std::numeric_limits<double>::infinity() * P), std::invalid_argument);
}

TEST_CASE("blocks without rows or columns take no room, and no inequality is made of them") {
  Lmi<> lmi;
  const auto P = lmi.symmetric("P", 2);
  CHECK(block({{P, limpid::zero(2, 0)}}).columns() == 2);
  CHECK(block({{P}, {limpid::zero(0, 2)}}).rows() == 2);
  CHECK(block({{P, 0}, {0, 0}}).rows() == 3);  // plain zeros are one high
  CHECK_THROWS_WITH_AS(lmi.require(limpid::zero(0, 0) > 0),
                       "Lmi: inequality: expected rows and columns > 0, got 0 (0 x 0)", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)limpid::zero(-1, 2), "Lmi: expected rows and columns >= 0, got -1 x 2",
                       std::invalid_argument);
}

TEST_CASE("terms outside the matrix, and unknowns that there are not, are refused") {
  Lmi<> lmi;
  const auto P = lmi.symmetric("P", 2);
  auto sum = P;
  const limpid::Ball<double> one(1.0);
  CHECK_THROWS_WITH_AS(sum.add(0, 2, 0, one), "Lmi: expected a place inside 2 x 2, got 1 x 1 at (2, 0)",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(sum.add(P, 1, 0), "Lmi: expected a place inside 2 x 2, got 2 x 2 at (1, 0)",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(sum.add(3, 0, 0, one), "Lmi: unknown: expected one of its Lmi, got 3", std::invalid_argument);
  CHECK_THROWS_AS(sum.add(-2, 0, 0, one), std::invalid_argument);
}

TEST_CASE("more unknowns than can be solved for are refused, also where their number is too large to count") {
  Lmi<> lmi;
  (void)lmi.symmetric("P", 2);
  CHECK_THROWS_WITH_AS((void)lmi.full("X", 100, 100),
                       "Lmi: X: expected at most 10000 unknowns in all, got 100 x 100 after 3", std::invalid_argument);
  CHECK_THROWS_AS((void)lmi.full("Y", 70'000, 70'000), std::invalid_argument);
  CHECK_THROWS_AS((void)lmi.symmetric("Q", 2'000'000'000), std::invalid_argument);
  CHECK(lmi.scalar("g").rows() == 1);  // a refused variable leaves no trace
}
