// SPDX-License-Identifier: MIT
#include <limpid/design/ball.hpp>
#include <support/precision.hpp>

#include <Eigen/Core>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using limpid::Ball;
using limpid::test::Fifty;

namespace {

/// Whether the ball holds a number known to 50 digits: its bounds are exact there.
template <typename Scalar>
bool holds(const Ball<Scalar>& ball, const Fifty& exact) {
  return Fifty(ball.lower()) <= exact && exact <= Fifty(ball.upper());
}

template <typename Scalar>
struct Draw {
  std::mt19937 generator{20'261};

  Scalar uniform(double from, double to) {
    return static_cast<Scalar>(std::uniform_real_distribution<double>(from, to)(generator));
  }
  // Of any size and sign.
  Scalar any() {
    using std::exp;
    return (uniform(0, 1) < Scalar(0.5) ? Scalar{-1} : Scalar{1}) * static_cast<Scalar>(exp(uniform(-30, 30)));
  }
};

}  // namespace

TEST_CASE_TEMPLATE("results of exact and of inexact numbers lie in the ball", Scalar, float, double, long double) {
  Draw<Scalar> draw;
  INFO("seed 20261");
  for (int i = 0; i < 4'000; ++i) {
    // A number of each ball, known exactly: its centre moved by a part of its radius.
    const Scalar a = draw.any(), b = draw.any();
    const Scalar ra = i % 2 == 0 ? Scalar{0} : std::abs(a) * draw.uniform(0, 1.5);
    const Scalar rb = i % 3 == 0 ? Scalar{0} : std::abs(b) * draw.uniform(0, 0.99);
    const Ball<Scalar> x{a, ra}, y{b, rb};
    const Fifty X = Fifty(a) + Fifty(ra) * Fifty(draw.uniform(-1, 1)),
                Y = Fifty(b) + Fifty(rb) * Fifty(draw.uniform(-1, 1));
    CAPTURE(x);
    CAPTURE(y);
    REQUIRE(holds<Scalar>(x + y, X + Y));
    REQUIRE(holds<Scalar>(x - y, X - Y));
    REQUIRE(holds<Scalar>(x * y, X * Y));
    REQUIRE(holds<Scalar>(x / y, X / Y));
    REQUIRE(holds<Scalar>(square(x), X * X));
    REQUIRE(holds<Scalar>(abs(x), abs(X)));
    REQUIRE(holds<Scalar>(sqrt(abs(y)), sqrt(abs(Y))));
    REQUIRE(holds<Scalar>(hull(x, y), X));
    REQUIRE(holds<Scalar>(hull(x, y), Y));
  }
}

TEST_CASE_TEMPLATE("exp lies in the ball, narrow and wide", Scalar, float, double, long double) {
  Draw<Scalar> draw;
  INFO("seed 20261");
  for (int i = 0; i < 2'000; ++i) {
    const Scalar a = draw.uniform(-80, 80), r = i % 2 == 0 ? Scalar{0} : draw.uniform(0, i % 3 == 0 ? 3 : 0.1);
    const Ball<Scalar> x{a, r};
    CAPTURE(x);
    REQUIRE(holds<Scalar>(exp(x), exp(Fifty(a) + Fifty(r) * Fifty(draw.uniform(-1, 1)))));
    // The rounding of the series, some 40 units in the last place, and of each squaring, times 8 |a| at most.
    const Scalar eps = std::numeric_limits<Scalar>::epsilon();
    if (r == Scalar{0})
      REQUIRE(exp(x).radius() <= Scalar(400) * (Scalar{1} + std::abs(a)) * eps * exp(x).magnitude() +
                                     Scalar(64) * std::numeric_limits<Scalar>::min());
  }
}

TEST_CASE("the bounds are near: a sum of exact numbers is off by a unit in the last place") {
  CHECK((Ball<double>(1) / Ball<double>(3)).radius() < 2.3e-16);
  CHECK((Ball<double>(1) + Ball<double>(1)).radius() < 4.5e-16);
}

TEST_CASE("division by a ball with zero in it is the whole line") {
  const Ball<double> quotient = Ball<double>(1) / Ball<double>(1, 1);
  CHECK_FALSE(quotient.bounded());
  CHECK(quotient.contains(1e300));
  CHECK_FALSE(quotient.certainly_positive());
  CHECK_FALSE((Ball<double>(1) / Ball<double>(0)).bounded());
}

TEST_CASE("roots of what may be negative are the whole line") {
  CHECK_FALSE(sqrt(Ball<double>(1, 1.5)).bounded());
  CHECK_FALSE(sqrt(Ball<double>(-1)).bounded());
  CHECK(sqrt(Ball<double>(0)).contains(0.0));
}

TEST_CASE("nothing is certain of what overflowed or is not a number") {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const Ball<double>& ball : {Ball<double>(inf), Ball<double>(nan), Ball<double>(1e300) * Ball<double>(1e300),
                                   Ball<double>(-1e308) - Ball<double>(1e308), exp(Ball<double>(1e5)),
                                   Ball<double>(0) * Ball<double>(inf), Ball<double>(1, nan), Ball<double>(nan, 1),
                                   Ball<double>::between(-inf, 0), hull(Ball<double>(nan), Ball<double>(1))}) {
    CAPTURE(ball);
    CHECK_FALSE(ball.bounded());
    CHECK_FALSE(ball.certainly_positive());
    CHECK_FALSE(ball.certainly_negative());
    CHECK_FALSE(ball.certainly_below(Ball<double>(1e308)));
    CHECK(ball.contains(5.0));
  }
}

TEST_CASE("what underflows is not lost") {
  const Ball<double> small(1e-200);
  CHECK(holds<double>(small * small, Fifty(1e-200) * Fifty(1e-200)));
  CHECK((small * small).upper() > 0);
  const Ball<double> doubtful = Ball<double>(1e-200, 1e-200) / Ball<double>(1e-150, 1e-170);
  CHECK(doubtful.upper() >= 2e-50);
}

TEST_CASE("comparisons are certain or nothing") {
  const Ball<double> x(1, 0.5), y(2, 0.4), z(2, 0.6);
  CHECK(x.certainly_below(y));
  CHECK(y.certainly_above(x));
  CHECK_FALSE(x.certainly_below(z));
  CHECK_FALSE(z.certainly_below(x));
  CHECK(x.certainly_positive());
  CHECK((-x).certainly_negative());
  CHECK_FALSE(Ball<double>(1, 1).certainly_positive());
}

TEST_CASE("squares are not negative but for rounding") {
  CHECK(square(Ball<double>(0.1, 1)).lower() >= -1e-14);
  CHECK(square(Ball<double>(0.1, 1)).contains(1.21));
}

TEST_CASE("fixed matrices of balls multiply, also with exact ones") {
  Eigen::Matrix<double, 2, 2> exact;
  exact << 1.0 / 3, 2, -4, 0.1;
  const Eigen::Matrix<Ball<double>, 2, 2> balls = exact.cast<Ball<double>>();
  const Eigen::Matrix<Ball<double>, 2, 2> product = balls * exact.transpose() * balls;
  const Eigen::Matrix<Fifty, 2, 2> E = exact.cast<Fifty>(), reference = E * E.transpose() * E;
  for (int i = 0; i < 4; ++i) CHECK(holds<double>(product(i), reference(i)));
}
