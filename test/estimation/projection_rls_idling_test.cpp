// SPDX-License-Identifier: MIT
#include <estimation/press.hpp>

#include <doctest/doctest.h>

#include <cmath>

using limpid::ProjectionRLS;
using limpid::test::idle;
using limpid::test::Linear;
using limpid::test::linear_model;
using limpid::test::Pair;
using limpid::test::press;

TEST_CASE("idling takes the gain to its limit and leaves it there") {
  Linear rls(linear_model());
  idle(rls, 804);                                                                     // exp(2 * 0.804) < 5
  CHECK(rls.gain(0)(0, 0) == doctest::Approx(1e9 * std::exp(1.608)).epsilon(1e-12));  // 804 roundings
  idle(rls, 5000);
  CHECK(rls.gain(0)(0, 0) == doctest::Approx(5e9).epsilon(1e-12));
  CHECK(rls.gain(0)(0, 0) <= 5e9 * (1 + 1e-12));
}

TEST_CASE("forgetting comes back as soon as there is room") {
  Linear rls(linear_model());
  idle(rls, 3000);
  press(rls, Pair(800, 33), 2);
  CHECK(rls.gain(0).trace() < 5e8);
  const double before = rls.gain(0).trace();
  idle(rls, 100);
  CHECK(rls.gain(0).trace() == doctest::Approx(before * std::exp(0.2)).epsilon(1e-12));
}

// (4.45) as printed is frozen by then and leaves (1100, 30) for good.
TEST_CASE_TEMPLATE("2 s after 1 s of idling the estimate is within 1 % of the truth", Scalar, float, double) {
  using Two = ProjectionRLS<2, 1, Scalar>;
  using Row2 = typename Two::Theta;
  for (const Row2& truth : {Row2(200, 40), Row2(800, 33), Row2(2000, 20)}) {
    CAPTURE(truth(0));
    Two rls({.lower = Row2(Scalar(200), Scalar(20)),
             .upper = Row2(Scalar(2000), Scalar(40)),
             .initial = Row2(Scalar(1100), Scalar(30)),
             .initial_gain = Row2(Scalar(1e9), Scalar(8e6))});
    idle(rls, 1000);
    press(rls, truth, 2);
    CHECK(((rls.theta() - truth) / truth).abs().maxCoeff() < Scalar(0.01));
  }
  using Three = ProjectionRLS<3, 1, Scalar>;
  using Row3 = typename Three::Theta;
  Three rls({.lower = Row3(Scalar(200), Scalar(20), Scalar(-55)),
             .upper = Row3(Scalar(2000), Scalar(40), Scalar(0)),
             .initial = Row3(Scalar(1100), Scalar(30), Scalar(0)),
             .initial_gain = Row3(Scalar(1e9), Scalar(8e6), Scalar(1e4))});
  idle(rls, 1000);
  const Row3 truth(Scalar(800), Scalar(33), Scalar(-2));
  press(rls, truth, 2);
  CHECK(((rls.theta() - truth) / truth).abs().maxCoeff() < Scalar(0.01));
}
