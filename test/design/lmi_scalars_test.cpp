// SPDX-License-Identifier: MIT
#include <limpid/design/lmi.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>

using limpid::Lmi;
using limpid::Verdict;

TEST_CASE_TEMPLATE("an Lmi works in float and long double", Scalar, float, long double) {
  using Matrix = Eigen::Matrix<Scalar, 2, 2>;
  for (const Scalar damping : {Scalar(-3), Scalar(0.25)}) {
    Matrix A;
    A << 0, 1, -2, damping;
    Lmi<Scalar> lmi;
    const auto P = lmi.symmetric("P", 2);
    lmi.require(A.transpose() * P + P * A < 0);
    lmi.require(P > 0);
    const auto result = lmi.solve();
    if (damping > 0) {
      CHECK(result.verdict == Verdict::infeasible);
      continue;
    }
    REQUIRE(result.verdict == Verdict::feasible);
    const Matrix value = result[P];
    CHECK(value(0, 0) > 0);
    CHECK(value.determinant() > 0);
  }
}
