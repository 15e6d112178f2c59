// SPDX-License-Identifier: MIT
// What a learnt law is made of: spline, branches, bristle.
#include <limpid/environment/maxwell_branches.hpp>
#include <limpid/environment/presliding.hpp>
#include <limpid/environment/spline_knots.hpp>

#include <doctest/doctest.h>

#include <cmath>

using limpid::MaxwellBranches;
using limpid::SplineKnots;

namespace {

// A spline with coefficients c(j).
template <typename C>
double value(const SplineKnots<>& knots, double x, C&& c) {
  const auto w = knots.at(x);
  double sum = 0;
  for (int k = 0; k < 4; ++k) sum += w.value[std::size_t(k)] * c(w.first + k);
  return sum;
}

SplineKnots<> knots_to(int high) {
  SplineKnots<> knots(0.5, 0.1);
  while (knots.high() < high) knots.extend_up();
  return knots;
}

}  // namespace

TEST_CASE(
    "the weights of a uniform cubic spline at a knot are 1/6, 4/6, 1/6, and of its slope -1/2, 0, 1/2 a spacing") {
  const auto w = knots_to(6).at(1.0);
  CHECK(w.first == 1);
  CHECK(w.value[0] == doctest::Approx(1 / 6.).epsilon(1e-15));
  CHECK(w.value[1] == doctest::Approx(4 / 6.).epsilon(1e-15));
  CHECK(w.value[2] == doctest::Approx(1 / 6.).epsilon(1e-15));
  CHECK(w.value[3] == 0);
  CHECK(w.slope[0] == doctest::Approx(-1.0));
  CHECK(w.slope[1] == 0);
  CHECK(w.slope[2] == doctest::Approx(1.0));
}

TEST_CASE("coefficients of a cubic polynomial give it back, with its slope") {
  // the blossom of x^3 at knots h (j-1, j, j+1): h^3 (j^3 - j)
  const SplineKnots<> knots = knots_to(8);
  const auto c = [](int j) { return 0.125 * (double(j) * j * j - j); };
  for (const double x : {0.07, 0.5, 1.234, 3.1}) {
    CHECK(value(knots, x, c) == doctest::Approx(x * x * x).epsilon(1e-13));
    const auto w = knots.at(x);
    double slope = 0;
    for (int k = 0; k < 4; ++k) slope += w.slope[std::size_t(k)] * c(w.first + k);
    CHECK(slope == doctest::Approx(3 * x * x).epsilon(1e-12));
  }
}

TEST_CASE("beyond its ends a spline goes on along its tangents") {
  const SplineKnots<> knots = knots_to(8);                               // from the knot 0 to the knot 3.5
  const auto c = [](int j) { return 0.25 * (double(j) * j - 1. / 3); };  // of x^2
  CHECK(value(knots, 5.5, c) == doctest::Approx(3.5 * 3.5 + 7 * 2).epsilon(1e-13));
  CHECK(value(knots, -2, c) == doctest::Approx(0).scale(1));
}

TEST_CASE("a coarser spline has the knots with even indices") {
  SplineKnots<> knots = knots_to(11);
  CHECK(knots.low() == -1);
  knots.coarsen();
  CHECK(knots.spacing() == 1.0);
  CHECK(knots.low() == -1);  // inner knots 0 to 5, one beyond at either end
  CHECK(knots.high() == 6);
}

TEST_CASE("a branch stretched at constant speed tends to v tau, and relaxes with its lag") {
  using Two = MaxwellBranches<2>;
  Two::Stretch chi{};
  const Two::Lags lags{0.1, 0.5};
  const auto step = Two::step_of(lags, 0.05);
  for (int i = 0; i < 4; ++i) Two::advance(chi, step, 0.02);
  CHECK(chi[0] == doctest::Approx(0.002 * (1 - std::exp(-2.))).epsilon(1e-13));
  CHECK(chi[1] == doctest::Approx(0.010 * (1 - std::exp(-0.4))).epsilon(1e-13));
  Two::advance(chi, step, 0);
  CHECK(chi[0] == doctest::Approx(0.002 * (1 - std::exp(-2.)) * std::exp(-0.5)).epsilon(1e-13));
}

TEST_CASE("a bristle bends to the sign of the velocity over its length, and no further") {
  double z = 0;
  for (int i = 0; i < 100; ++i) z = limpid::presliding_after(z, 0.01, 1e-4, 1e-5);
  CHECK(z == doctest::Approx(1 - std::exp(-10.)).epsilon(1e-12));  // 100 um of travel, 10 um of length
  z = limpid::presliding_after(z, -0.01, 1e-3, 1e-5);
  CHECK(z == doctest::Approx(-1 + (2 - std::exp(-10.)) * std::exp(-1.)).epsilon(1e-12));
  CHECK(limpid::presliding_after(0.3, 0.0, 1.0, 1e-5) == doctest::Approx(0.3).epsilon(1e-15));
}
