// SPDX-License-Identifier: MIT
#include <limpid/core/cholesky_3.hpp>

#include <doctest/doctest.h>

#include <cmath>

using limpid::Cholesky3;

namespace {

// G G' of G = (2 0 0; 1 3 0; -1 2 1), by hand
Cholesky3<> factor() {
  Eigen::Matrix3d S;
  S << 4, 2, -2, 2, 10, 5, -2, 5, 6;
  return Cholesky3<>(S);
}

}  // namespace

TEST_CASE("the factor of three is found, exactly where all its entries are integers") {
  Eigen::Matrix3d expected;
  expected << 2, 0, 0, 1, 3, 0, -1, 2, 1;
  CHECK((factor().lower().array() == expected.array()).all());
}

TEST_CASE("a vector is whitened and solved for by the factor") {
  CHECK((factor().whitened(Eigen::Vector3d(2, 7, 4)) - Eigen::Vector3d(1, 2, 1)).norm() == 0);
  // S (1, 1, 1)'; of condition 31: some roundings
  CHECK((factor().solve(Eigen::Vector3d(4, 17, 9)) - Eigen::Vector3d(1, 1, 1)).norm() < 1e-14);
}

TEST_CASE("the determinant is the square of the product of the diagonal") {
  CHECK(factor().log_determinant() == doctest::Approx(std::log(36.)).epsilon(1e-15));
}

TEST_CASE("of a matrix that is not positive definite the factor is not finite") {
  const Eigen::Matrix3d S = Eigen::Vector3d(1, -1, 1).asDiagonal();
  CHECK(std::isnan(Cholesky3<>(S).lower()(1, 1)));
}
