// SPDX-License-Identifier: MIT
#include "design/lmi_cases.hpp"
#include "design_instances.hpp"

#include <limpid/design/lmi.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>

#include <cmath>
#include <random>

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using limpid::block;
using limpid::identity;
using limpid::Lmi;
using limpid::symmetric_block;
using limpid::Verdict;
using limpid::test::Lyapunov;
using limpid::test::matrix;

namespace {

MatrixXd random_matrix(std::mt19937& random, int rows, int columns) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(random); });
}

}  // namespace

TEST_CASE("a stable matrix has a Lyapunov matrix, and it is one") {
  const Matrix2d A = matrix(0, 1, -2, -3);
  const Lyapunov problem(A);
  const auto result = problem.lmi.solve();
  REQUIRE(result.verdict == Verdict::feasible);
  CHECK(result.margin >= 0);
  const Matrix2d value = result[problem.P];
  CHECK(value == value.transpose());
  CHECK(value(0, 0) > 0);
  CHECK(value.determinant() > 0);
  const Matrix2d decay = -(A.transpose() * value + value * A);
  CHECK(decay(0, 0) > 0);
  CHECK(decay.determinant() > 0);
}

TEST_CASE("an unstable matrix has none, and the multipliers prove it") {
  const Matrix2d A = matrix(0, 1, -2, 0.25);
  const auto result = Lyapunov(A).lmi.solve();
  REQUIRE(result.verdict == Verdict::infeasible);
  // <-(A'P + P A), Z1> + <P, Z2> = 0 for all P: Z2 = A Z1 + Z1 A'
  const auto& Z = result.multipliers.Z;
  REQUIRE(Z.size() == 2);
  const MatrixXd rest = Z[1] - (A * Z[0] + Z[0] * A.transpose());
  CHECK(rest.norm() < 1e-14);  // some roundings of numbers below 1
  CHECK(Z[0].determinant() > 0);
  CHECK(Z[1].determinant() > 0);
  CHECK(Z[0].trace() + Z[1].trace() == doctest::Approx(1).epsilon(1e-14));
}

TEST_CASE("the largest margin of a Lyapunov inequality is the closed form's") {
  // A = -I: -(A'P + P A) = 2 P and P, with tr P = 1: P = I/2, t = 1/2.
  Lmi<> lmi;
  const auto P = lmi.symmetric("P", 2);
  lmi.require(-2.0 * P < 0);
  lmi.require(P > 0);
  lmi.normalise(trace(P) == 1);
  lmi.maximise_margin();
  const auto result = lmi.solve();
  REQUIRE(result.feasible());
  CHECK(result.margin <= 0.5);
  CHECK(result.margin == doctest::Approx(0.5).epsilon(1e-9));
  CHECK(result.margin_bound >= 0.5);
  CHECK(result.margin_bound == doctest::Approx(0.5).epsilon(1e-9));
  CHECK(result[trace(P)](0, 0) == doctest::Approx(1).epsilon(1e-14));
}

TEST_CASE("a margin below zero is bounded too, and the verdict is infeasible") {
  Lmi<> lmi;
  const auto x = lmi.scalar("x");
  lmi.require(x > 1);
  lmi.require(x < 0.5);
  lmi.maximise_margin();  // at x = 3/4
  const auto result = lmi.solve();
  CHECK(result.verdict == Verdict::infeasible);
  CHECK(result.margin == doctest::Approx(-0.25).epsilon(1e-8));
  CHECK(result.margin_bound == doctest::Approx(-0.25).epsilon(1e-8));
}

TEST_CASE("inequalities with constants: between two numbers or none") {
  const auto between = [](double low, double high) {
    Lmi<> lmi;
    const auto x = lmi.scalar("x");
    lmi.require(x > low);
    lmi.require(x < high);
    return lmi.solve();
  };
  CHECK(between(1, 1.0000001).verdict == Verdict::feasible);
  CHECK(between(1, 0.9999999).verdict == Verdict::infeasible);
  const auto touching = between(1, 1);
  CHECK(touching.verdict == Verdict::undecided);
  CHECK(touching.reason.find("the largest margin is 0 to rounding") != std::string::npos);
}

TEST_CASE("borderline: a marginally stable matrix is undecided, with the reason") {
  const Lyapunov problem(matrix(0, 1, -1, 0));
  const auto result = problem.lmi.solve();
  CHECK(result.verdict != Verdict::feasible);  // Z1 = I proves it infeasible, which rounding may hide
  CHECK(!result.reason.empty());
  CHECK(std::isnan(result[problem.P](0, 0)) == true);
}

TEST_CASE("alternatives by Farkas: one of two systems holds, never both") {
  constexpr unsigned seed = 20261121;
  CAPTURE(seed);
  std::mt19937 random(seed);
  int feasible = 0;
  for (int trial = 0; trial < 40; ++trial) {
    // Scalars: a_i x + b_i y + c_i > 0 for four random lines; decided by hand over the vertices.
    const MatrixXd lines = random_matrix(random, 4, 3);
    Lmi<> lmi;
    const auto x = lmi.scalar("x"), y = lmi.scalar("y");
    for (int i = 0; i < 4; ++i) lmi.require(lines(i, 0) * x + lines(i, 1) * y + lines(i, 2) > 0);
    const auto result = lmi.solve();
    REQUIRE(result.verdict != Verdict::undecided);
    if (result.feasible()) {
      ++feasible;
      for (int i = 0; i < 4; ++i) {
        CHECK(lines(i, 0) * result.number(x) + lines(i, 1) * result.number(y) + lines(i, 2) > 0);
      }
    } else {
      Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
      for (int i = 0; i < 4; ++i) sum += result.multipliers.Z[static_cast<std::size_t>(i)](0, 0) * lines.row(i);
      CHECK(std::abs(sum[0]) < 1e-14);
      CHECK(std::abs(sum[1]) < 1e-14);
      CHECK(sum[2] < 1e-14);
    }
  }
  CHECK(feasible > 10);
  CHECK(feasible < 40);
}

TEST_CASE("inequalities that contradict each other are found among others") {
  Lmi<> lmi;
  const auto x = lmi.scalar("x"), y = lmi.scalar("y"), z = lmi.scalar("z");
  lmi.require(y > 0);
  lmi.require(x > 2);
  lmi.require(y < z);
  lmi.require(x < 1);
  const auto result = lmi.solve();
  REQUIRE(result.verdict == Verdict::infeasible);
  CHECK(result.multipliers.Z[0](0, 0) == 0);  // they have no part in it
  CHECK(result.multipliers.Z[2](0, 0) == 0);
}

TEST_CASE("a badly scaled problem gets the verdict of the well scaled one") {
  // Coordinates of 64 and 1/64, so that entries of P differ by 2^24, and an inequality times 1e8.
  const Matrix2d T = matrix(64, 0, 0, 1.0 / 64);
  for (const double damping : {-3.0, 0.25}) {
    const Matrix2d A = T * matrix(0, 1, -2, damping) * matrix(1.0 / 64, 0, 0, 64);
    Lmi<> lmi;
    const auto P = lmi.symmetric("P", 2);
    lmi.require(1e8 * (A.transpose() * P + P * A) < 0);
    lmi.require(P > 0);
    CHECK(lmi.solve().verdict == (damping < 0 ? Verdict::feasible : Verdict::infeasible));
  }
}

TEST_CASE("a hundred unknowns in blocks of forty") {
  constexpr unsigned seed = 7;
  CAPTURE(seed);
  std::mt19937 random(seed);
  const int n = 13;  // 91 unknowns in P
  const MatrixXd G = random_matrix(random, n, n);
  const MatrixXd A = G - (G.norm() + 0.1) * MatrixXd::Identity(n, n);  // its numerical range is left of 0
  for (const bool stable : {true, false}) {
    const MatrixXd A_used = stable ? A : MatrixXd(-A);
    Lmi<> lmi;
    const auto P = lmi.symmetric("P", n);
    const auto g = lmi.full("g", 3, 3);
    const auto one = lmi.scalar("one");
    // 3 n + 1 = 40 rows
    const auto lyapunov = A_used.transpose() * P + P * A_used;
    lmi.require(symmetric_block({{lyapunov}, {0, -P}, {0, 0, lyapunov}, {0, 0, 0, trace(lyapunov)}}) < 0);
    lmi.require(g + transpose(g) > 0);
    lmi.require(one * identity(3) > g + transpose(g));
    const auto result = lmi.solve();
    CHECK(result.verdict == (stable ? Verdict::feasible : Verdict::infeasible));
    CHECK(lmi.problem().unknowns == 101);
  }
}

TEST_CASE("unknowns that occur nowhere, and coefficients that are zero, do no harm") {
  Lmi<> lmi;
  const auto P = lmi.symmetric("P", 2), idle = lmi.symmetric("idle", 3);
  lmi.require(P + 0.0 * P > 0);
  lmi.require(block({{P, 0}, {0, identity(1)}}) > 0);
  const auto result = lmi.solve();
  REQUIRE(result.feasible());
  CHECK(result[idle].norm() == 0);
  Lmi<> impossible;
  (void)impossible.scalar("idle");
  impossible.require(limpid::zero<>(2, 2) > 0);
  CHECK(impossible.solve().verdict != Verdict::feasible);
  Lmi<> constant;
  (void)constant.scalar("idle");
  constant.require(identity(2) > 0);
  CHECK(constant.solve().verdict == Verdict::feasible);
}

TEST_CASE("an equation is kept, whichever its sign") {
  for (const double d : {2.0, -2.0}) {
    Lmi<> lmi;
    const auto x = lmi.scalar("x"), y = lmi.scalar("y");
    lmi.require(x > 0);
    lmi.require(x + y > 0);
    lmi.normalise(x + 3 * y == d);
    const auto result = lmi.solve();
    REQUIRE(result.feasible());
    CHECK(result.number(x) + 3 * result.number(y) == doctest::Approx(d).epsilon(1e-13));
  }
  Lmi<> lmi;
  const auto P = lmi.symmetric("P", 2);
  lmi.require(P > 0);
  lmi.normalise(trace(P) == -1);
  CHECK(lmi.solve().verdict == Verdict::infeasible);
}

TEST_CASE("the same problem has the same answer, to the bit") {
  const auto solve = [] { return Lyapunov(matrix(-1, 0, 2, -3)).lmi.solve(); };
  CHECK(solve().unknowns == solve().unknowns);
}
