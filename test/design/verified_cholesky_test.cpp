// SPDX-License-Identifier: MIT
#include "eigen_instances.hpp"
#include "support/precision.hpp"

#include <limpid/design/verified_cholesky.hpp>

#include <Eigen/Core>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using limpid::Ball;
using limpid::verified_least_eigenvalue;
using limpid::verified_positive_definite;
using limpid::test::Fifty;

// Of one size at run time where no fixed one is meant: the solver of eigenvalues takes a compiler long for each.
using Balls = Eigen::Matrix<Ball<double>, Eigen::Dynamic, Eigen::Dynamic>;

/// In 50 digits, of the doubles as they are.
template <typename Scalar, int n>
bool positive_definite_in_fifty(const Eigen::Matrix<Scalar, n, n>& A) {
  Eigen::Matrix<Fifty, n, n> L = A.template cast<Fifty>();
  for (int j = 0; j < n; ++j) {
    if (!(L(j, j) > 0)) return false;
    for (int i = j + 1; i < n; ++i) {
      const Fifty factor = L(i, j) / L(j, j);
      for (int k = j + 1; k <= i; ++k) L(i, k) -= factor * L(k, j);
    }
  }
  return true;
}

}  // namespace

TEST_CASE("A positive definite matrix is accepted, an indefinite one and a singular one are not") {
  Eigen::Matrix3d A;
  A << 4, 1, 0, 1, 3, -1, 0, -1, 2;
  CHECK(verified_positive_definite(A));
  A(2, 2) = -2;
  CHECK_FALSE(verified_positive_definite(A));
  const Eigen::Matrix3d singular = Eigen::Vector3d(1, 2, 3) * Eigen::RowVector3d(1, 2, 3);
  CHECK_FALSE(verified_positive_definite(singular));
}

TEST_CASE_TEMPLATE("What is accepted is positive definite in 50 digits, however close to singular", Scalar, float,
                   double) {
  constexpr unsigned seed = 3;
  INFO("seed ", seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  int accepted = 0, positive = 0;
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    Eigen::Matrix<Scalar, 5, 5> G;
    for (auto& entry : G.reshaped()) entry = static_cast<Scalar>(normal(random));
    G.row(4).setZero();
    Eigen::Matrix<Scalar, 5, 5> A = G.transpose() * G;  // singular to rounding
    A = (A + A.transpose()).eval() / 2;
    const Scalar shift = std::numeric_limits<Scalar>::epsilon() * A.trace() * static_cast<Scalar>(normal(random)) * 8;
    A.diagonal().array() += shift;
    if (positive_definite_in_fifty(A)) ++positive;
    if (!verified_positive_definite(A)) continue;
    ++accepted;
    CHECK(positive_definite_in_fifty(A));
  }
  CHECK(accepted > 0);         // the bound is of the size of the rounding
  CHECK(accepted < positive);  // and the test was at the border
}

TEST_CASE("The bound on the error is used up to its last digit") {
  const Eigen::Matrix4d A = Eigen::Matrix4d::Identity();
  CHECK(verified_positive_definite(A, 0.999));
  CHECK_FALSE(verified_positive_definite(A, 1.0));
}

TEST_CASE("Of a matrix of balls every matrix has to be positive definite") {
  // [1 r r; r 1 r; r r 1] has the eigenvalue 1 - r twice; with -r it has 1 - 2 r.
  Balls A(3, 3);
  for (const double r : {0.49, 0.51}) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) A(i, j) = i == j ? Ball<double>(1.0) : Ball<double>(0.0, r);
    }
    CHECK(verified_positive_definite(A) == (r < 0.5));
  }
  A(1, 1) = Ball<double>::whole_line();
  CHECK_FALSE(verified_positive_definite(A));
}

TEST_CASE("Numbers that are none prove nothing") {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(2, 2);
    A(0, 0) = bad;
    CHECK_FALSE(verified_positive_definite(A));
    CHECK(verified_least_eigenvalue(A) == -std::numeric_limits<double>::infinity());
    A = Eigen::MatrixXd::Identity(2, 2);
    A(1, 0) = bad;
    CHECK_FALSE(verified_positive_definite(A));
    CHECK_FALSE(verified_positive_definite(Eigen::MatrixXd(Eigen::MatrixXd::Identity(2, 2)), bad));
  }
}

TEST_CASE("The bound of the least eigenvalue is below it and close") {
  // [2 1; 1 2] twice and 5: 1, 1, 3, 3, 5
  Eigen::Matrix<double, 5, 5> A = Eigen::Matrix<double, 5, 5>::Zero();
  A.diagonal() << 2, 2, 2, 2, 5;
  A(1, 0) = A(0, 1) = A(3, 2) = A(2, 3) = 1;
  CHECK(verified_least_eigenvalue(A) < 1);
  CHECK(verified_least_eigenvalue(A) > 1 - 1e-12);
  A.diagonal().array() -= 2;
  CHECK(verified_least_eigenvalue(A) < -1);
  CHECK(verified_least_eigenvalue(A) > -1 - 1e-12);

  Balls balls(5, 5);
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) balls(i, j) = Ball<double>(A(i, j), i == j ? 0.25 : 0.0);
  }
  CHECK(verified_least_eigenvalue(balls) < -1.25);
  CHECK(verified_least_eigenvalue(balls) > -1.6);
}

TEST_CASE("A ball that is not a number, in any row, proves nothing") {
  const Ball<double> nothing = Ball<double>::whole_line() * Ball<double>(0.0);
  for (int bad = 0; bad < 3; ++bad) {
    CAPTURE(bad);
    Balls A = Eigen::MatrixXd::Identity(3, 3).cast<Ball<double>>();
    A(bad, bad) = Ball<double>(1.0) + nothing;
    CHECK_FALSE(verified_positive_definite(A));
    CHECK(verified_least_eigenvalue(A) == -std::numeric_limits<double>::infinity());
  }
}

TEST_CASE("A matrix that is not symmetric, not square or empty proves nothing") {
  const double none = -std::numeric_limits<double>::infinity();
  Eigen::MatrixXd A(2, 2);
  A << 1, 100, 0, 1;  // x'A x < 0 at x = (1, -1)
  CHECK_FALSE(verified_positive_definite(A));
  CHECK(verified_least_eigenvalue(A) == none);
  CHECK_FALSE(verified_positive_definite(Eigen::MatrixXd(Eigen::MatrixXd::Ones(2, 3))));
  CHECK_FALSE(verified_positive_definite(Eigen::MatrixXd(Eigen::MatrixXd::Ones(3, 2))));
  CHECK(verified_least_eigenvalue(Eigen::MatrixXd(0, 0)) == none);
  Balls balls = Eigen::MatrixXd::Identity(2, 2).cast<Ball<double>>();
  balls(0, 1) = Ball<double>(0.25, 0.25);  // has 0 in common with its mirror image
  CHECK(verified_positive_definite(balls));
  balls(0, 1) = Ball<double>(0.5, 0.25);
  CHECK_FALSE(verified_positive_definite(balls));
}

TEST_CASE("An error below zero proves nothing") {
  Eigen::MatrixXd A(2, 2);
  A << 1, 0, 0, -1;
  CHECK_FALSE(verified_positive_definite(A, -2.0));
}
