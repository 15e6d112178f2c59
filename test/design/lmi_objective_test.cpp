// SPDX-License-Identifier: MIT
#include "design/lmi_cases.hpp"
#include "design_instances.hpp"

#include <limpid/design/lmi.hpp>

#include <doctest/doctest.h>

#include <Eigen/Core>

#include <cmath>
#include <limits>

using Eigen::Matrix2d;
using limpid::block;
using limpid::identity;
using limpid::Lmi;
using limpid::symmetric_block;
using limpid::test::matrix;

TEST_CASE("the H-infinity norm of a first order lag is found and bounded from both sides") {
  // x' = -a x + b w, z = c x: the norm is b c/a. Bounded real lemma, with the square of the norm as unknown.
  const double a = 2, b = 3, c = 0.5;
  Lmi<> lmi;
  const auto P = lmi.scalar("P"), square = lmi.scalar("norm^2");
  lmi.require(symmetric_block({{-2 * a * P + c * c}, {b * P, -square}}) < 0);
  lmi.require(P > 0);
  lmi.minimise(square);
  const auto result = lmi.solve();
  REQUIRE(result.feasible());
  const double exact = b * c / a * b * c / a;
  CHECK(result.objective >= exact);  // proved from above
  CHECK(result.objective == doctest::Approx(exact).epsilon(1e-7));
  CHECK(result.objective_bound <= exact);  // and from below
  CHECK(result.objective_bound == doctest::Approx(exact).epsilon(1e-7));
}

TEST_CASE("the H-infinity norm of a resonance is found") {
  // 1/(s^2 + 2 zeta s + 1) has the norm 1/(2 zeta sqrt(1 - zeta^2)) for zeta < 1/sqrt 2.
  const double zeta = 0.25;
  const Matrix2d A = matrix(0, 1, -1, -2 * zeta);
  const Eigen::Vector2d B(0, 1);
  const Eigen::RowVector2d C(1, 0);
  Lmi<> lmi;
  const auto P = lmi.symmetric("P", 2), square = lmi.scalar("norm^2");
  lmi.require(block({{A.transpose() * P + P * A + C.transpose() * C, P * B}, {transpose(P * B), -square}}) < 0);
  lmi.require(P > 0);
  lmi.minimise(square);
  const auto result = lmi.solve();
  REQUIRE(result.feasible());
  const double exact = 1 / (4 * zeta * zeta * (1 - zeta * zeta));
  CHECK(result.objective >= exact);
  CHECK(result.objective == doctest::Approx(exact).epsilon(1e-6));
  CHECK(result.objective_bound <= exact);
}

TEST_CASE("the least eigenvalue is enclosed, and a largest one by minimising") {
  const Matrix2d A = matrix(2, 1, 1, -3);
  const double root = std::sqrt(29.0) / 2;
  Lmi<> least;
  const auto t = least.scalar("t");
  least.require(A > t * identity(2));
  least.maximise(t);
  const auto low = least.solve();
  REQUIRE(low.feasible());
  CHECK(low.objective <= -0.5 - root);
  CHECK(low.objective_bound >= -0.5 - root);
  CHECK(low.objective_bound - low.objective < 1e-8);
  Lmi<> largest;
  const auto s = largest.scalar("s");
  largest.require(A < s * identity(2));
  largest.minimise(s);
  const auto high = largest.solve();
  REQUIRE(high.feasible());
  CHECK(high.objective >= -0.5 + root);
  CHECK(high.objective_bound <= -0.5 + root);
  CHECK(high.number(s) == high.objective);
}

TEST_CASE("an objective that is unbounded along one direction only, by however little, has no bound") {
  for (const double e : {0.0, 1e-20, 1e-40, 1e-60}) {
    CAPTURE(e);
    Lmi<> lmi;
    const auto x = lmi.scalar("x"), y = lmi.scalar("y"), z = lmi.scalar("z");
    lmi.require(1.3 - 0.7 * (x + y) > 0);
    lmi.require(1.1 + 0.9 * (x + y) > 0);
    lmi.require(3 - z > 0);
    lmi.require(z + 1 > 0);
    lmi.maximise(e == 0 ? z + 0.3 * (x + y) : z + 0.3 * (x + y) + e * y);  // along y = -x
    const double bound = lmi.solve().objective_bound;
    if (e == 0) {
      CHECK(bound >= 3 + 0.3 * 1.3 / 0.7 - 1e-15);  // x + y < 1.3/0.7
      CHECK(bound == doctest::Approx(3 + 0.3 * 1.3 / 0.7).epsilon(1e-6));
    } else {
      CHECK(bound == std::numeric_limits<double>::infinity());
    }
  }
}
