// SPDX-License-Identifier: MIT
#include <limpid/core/second_order_step.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using limpid::SecondOrderStep;

namespace {

template <typename Scalar>
using One = Eigen::Array<Scalar, 1, 1>;

template <typename Scalar>
SecondOrderStep<1, Scalar> step_of(double kappa, double beta, double h) {
  SecondOrderStep<1, Scalar> step;
  step.set(One<Scalar>(Scalar(kappa)), One<Scalar>(Scalar(beta)), Scalar(h));
  return step;
}

}  // namespace

TEST_CASE_TEMPLATE("a free mass moves by Newton's law", Scalar, float, double, long double) {
  const auto step = step_of<Scalar>(0, 0, 0.5);
  One<Scalar> x(Scalar(1)), v(Scalar(2));
  step.advance(x, v, One<Scalar>(Scalar(3)), One<Scalar>(Scalar(9)));  // a = 3 + 12 t
  const Scalar roundings = 8 * std::numeric_limits<Scalar>::epsilon();
  CHECK(std::abs(v[0] - Scalar(5)) <= 5 * roundings);      // 2 + 3/2 + 12/8
  CHECK(std::abs(x[0] - Scalar(2.625)) <= 3 * roundings);  // 1 + 1 + 3/8 + 2/8
}

// An oscillator turned by a right angle: x and v / omega change places.
TEST_CASE_TEMPLATE("an undamped oscillator turns", Scalar, float, double, long double) {
  const double omega = 8;
  const auto step = step_of<Scalar>(omega * omega, 0, M_PI / 16);
  One<Scalar> x(Scalar(1)), v(Scalar(-4)), none(Scalar(0));
  step.advance(x, v, none, none);
  const Scalar roundings = 32 * std::numeric_limits<Scalar>::epsilon() + Scalar(2e-16);  // of pi as a double
  CHECK(std::abs(x[0] - Scalar(-0.5)) <= roundings);
  CHECK(std::abs(v[0] - Scalar(-8)) <= 8 * roundings);
}

TEST_CASE_TEMPLATE("two halves make the whole, over short, long and stiff steps", Scalar, float, double, long double) {
  for (const double kappa : {0.0, 2000.0, 20'000.0, -300.0}) {
    for (const double beta : {0.0, 450.0, 10'000.0}) {
      for (const double h : {0x1p-10, 0x1p-6, 0x1p-3}) {
        CAPTURE(kappa);
        CAPTURE(beta);
        CAPTURE(h);
        const auto whole = step_of<Scalar>(kappa, beta, h), half = step_of<Scalar>(kappa, beta, h / 2);
        One<Scalar> x(Scalar(1)), v(Scalar(-20)), y = x, w = v;
        const One<Scalar> f0(Scalar(300)), f1(Scalar(-500)), middle(Scalar(-100));
        whole.advance(x, v, f0, f1);
        half.advance(y, w, f0, middle);
        half.advance(y, w, middle, f1);
        // each doubling rounds some ten times; there are up to 12 of them; |x| <= 40 and |v| <= 600 on the way (kappa <
        // 0)
        const Scalar roundings = 120 * std::numeric_limits<Scalar>::epsilon();
        CHECK(std::abs(x[0] - y[0]) <= 40 * roundings);
        CHECK(std::abs(v[0] - w[0]) <= 600 * roundings);
      }
    }
  }
}

TEST_CASE("a stiff damper leaves the static answer and no overflow") {
  const auto step = step_of<double>(1e6, 1e9, 1e6);
  One<double> x(5.0), v(7.0);
  step.advance(x, v, One<double>(2e6), One<double>(2e6));
  CHECK(x[0] == doctest::Approx(2).epsilon(1e-12));  // f / kappa; some 50 doublings
  CHECK(std::abs(v[0]) < 1e-9);
}

TEST_CASE("axes move each by its own") {
  SecondOrderStep<2> step;
  step.set({100, 400}, {3, 0}, 0.01);
  Eigen::Array2d x(1, 2), v(0, 1);
  step.advance(x, v, {5, 6}, {7, 8});
  const auto second = step_of<double>(400, 0, 0.01);
  One<double> y(2.0), w(1.0);
  second.advance(y, w, One<double>(6.0), One<double>(8.0));
  CHECK(x[1] == doctest::Approx(y[0]).epsilon(1e-15));
  CHECK(v[1] == doctest::Approx(w[0]).epsilon(1e-15));
}

TEST_CASE("the responses are the integrals of each other") {
  const auto step = step_of<double>(0, 4, 0.5);  // g = (1 - exp(-4 h)) / 4
  const double e = std::exp(-2.0), g = (1 - e) / 4, s = (0.5 - g) / 4, r = (0.125 - s) / 4;
  CHECK(step.impulse_response()[0] == doctest::Approx(g).epsilon(1e-15));
  CHECK(step.step_response()[0] == doctest::Approx(s).epsilon(4e-15));  // (0.5 - g) cancels a little
  CHECK(step.ramp_response()[0] == doctest::Approx(r).epsilon(1e-14));
}

TEST_CASE("neither setting nor stepping asks for memory") {
  SecondOrderStep<3> step;
  Eigen::Array3d x = Eigen::Array3d::Zero(), v = x;
  limpid::test::check_no_allocation([&] {
    step.set(Eigen::Array3d::Constant(2000), Eigen::Array3d::Constant(45), 0.001);
    step.advance(x, v, Eigen::Array3d::Ones(), Eigen::Array3d::Ones());
  });
}

TEST_CASE_TEMPLATE("a size beyond the scalar's range ends in NaN, not in an endless loop", Scalar, float, double,
                   long double) {
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity(), largest = std::numeric_limits<Scalar>::max();
  constexpr Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();
  const auto answer = [](Scalar kappa, Scalar beta, Scalar h) {
    SecondOrderStep<1, Scalar> step;
    step.set(One<Scalar>(kappa), One<Scalar>(beta), h);
    One<Scalar> x(Scalar(1)), v(Scalar(2)), none(Scalar(0));
    step.advance(x, v, none, none);
    return x[0];
  };
  for (const Scalar bad : {infinity, -infinity, nan}) {
    CHECK(std::isnan(answer(bad, 30, Scalar(0.001))));
    CHECK(std::isnan(answer(1000, bad, Scalar(0.001))));
    CHECK(std::isnan(answer(1000, 30, bad)));
  }
  CHECK(std::isnan(answer(1, largest, 4)));  // beta h overflows
  CHECK(std::abs(answer(0, largest, Scalar(0.5)) - 1) <=
        4 * std::numeric_limits<Scalar>::epsilon());  // at rest at once
}

// Their layout must not depend on compiler flags: two translation units may be compiled for different processors.
static_assert(limpid::lanes_for<float>(3) == 4 && limpid::lanes_for<double>(3) == 4);
static_assert(limpid::lanes_for<long double>(3) == 3 && limpid::lanes_for<double>(2) == 2);
static_assert(sizeof(limpid::Lanes<3, double>) == 4 * sizeof(double));
static_assert(alignof(limpid::Lanes<3, double>) == alignof(double));
