// SPDX-License-Identifier: MIT
#include <limpid/core/second_order_step.hpp>
#include <limpid/core/small_step_series.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using limpid::SecondOrderStep;
using limpid::detail::SmallStepSeries;
using limpid::test::Fifty;

namespace {

template <typename Scalar>
using One = Eigen::Array<Scalar, 1, 1>;

// What the coefficients leave out of s/h^2 and r/h^3, of 1/2 and 1/6.
template <typename Scalar>
Fifty error_at(const Fifty& B, const Fifty& K) {
  const auto& c = SmallStepSeries<Scalar>::coefficients;
  constexpr std::size_t terms = 48;  // the next one is below 1e-80
  std::vector<Fifty> u{1, -B}, missing(terms + 2);
  Fifty factorial = 1;
  for (std::size_t n = 2; n < terms + 2; ++n) {
    factorial *= Fifty(n);
    missing[n] = (n - 2 < c.size() ? Fifty(Scalar(c[n - 2])) : Fifty(0)) - 1 / factorial;
    u.push_back(-B * u[n - 1] - K * u[n - 2]);
  }
  Fifty s = 0, r = 0;
  for (std::size_t n = 0; n + 3 < terms + 2; ++n) {
    s += missing[n + 2] * u[n];
    r += missing[n + 3] * u[n];
  }
  return std::max<Fifty>(2 * abs(s), 6 * abs(r));
}

// From 0 to `largest`, the extrema of a Chebyshev polynomial: there are 49.
std::vector<Fifty> extrema(double largest) {
  std::vector<Fifty> points;
  for (int i = 0; i <= 48; ++i) points.push_back(Fifty(largest * (0.5 - 0.5 * std::cos(M_PI * i / 48))));
  return points;
}

template <typename Scalar>
Fifty largest_error() {
  Fifty largest = 0;
  for (const Fifty& B : extrema(SmallStepSeries<Scalar>::largest_B)) {
    for (const Fifty& K : extrema(SmallStepSeries<Scalar>::largest_K)) {
      largest = std::max(largest, error_at<Scalar>(B, K));
    }
  }
  return largest;
}

template <typename Scalar>
struct Place {
  Scalar B, K;
};

// Around the border of the short steps, and inside; h = 1, so that B and K are beta and kappa.
template <typename Scalar>
std::vector<Place<Scalar>> places() {
  const auto B = Scalar(SmallStepSeries<Scalar>::largest_B), K = Scalar(SmallStepSeries<Scalar>::largest_K);
  const auto around = [](Scalar border) {
    return std::vector<Scalar>{0,
                               std::numeric_limits<Scalar>::min(),
                               -std::numeric_limits<Scalar>::epsilon(),
                               border / 64,
                               border / 3,
                               std::nextafter(border, Scalar(0)),
                               border,
                               std::nextafter(border, Scalar(1)),
                               border * 2};
  };
  std::vector<Place<Scalar>> all;
  for (const Scalar b : around(B)) {
    for (const Scalar k : around(K)) all.push_back({b, k});
  }
  return all;
}

template <typename Scalar>
SecondOrderStep<1, Scalar> step_at(const Scalar& B, const Scalar& K) {
  SecondOrderStep<1, Scalar> step;
  step.set(One<Scalar>(K), One<Scalar>(B), Scalar(1));
  return step;
}

}  // namespace

// A polynomial of degree d is nowhere larger than 1/cos(pi d/96) times its largest value at those points (Ehlich and
// Zeller), in each variable: of degree 22 in B and 11 in K, 1.33 and 1.07; terms beyond sum to less than 1e-24.
TEST_CASE("the coefficients of short steps leave out less than a unit in the last place, everywhere") {
  const Fifty between = Fifty(1.33) * Fifty(1.07);
  CHECK(between * largest_error<double>() < Fifty(std::numeric_limits<double>::epsilon()));
  CHECK(between * largest_error<float>() < Fifty(std::numeric_limits<float>::epsilon()));
  // 7.5e-17 by the fit; the coefficients' roundings, of 2^-53 each, add 2 (c_3 B + c_4 B^2 + ...) 2^-53 to s
  CHECK(largest_error<double>() < Fifty(9.6e-17));
}

TEST_CASE_TEMPLATE("the responses are right to 4 units in the last place on both sides of the border", Scalar, float,
                   double) {
  const Fifty tolerance = 4 * Fifty(std::numeric_limits<Scalar>::epsilon());
  for (const Place<Scalar>& place : places<Scalar>()) {
    const Scalar B = place.B, K = place.K;
    CAPTURE(B);
    CAPTURE(K);
    const auto step = step_at<Scalar>(B, K);
    const auto exact = step_at<Fifty>(Fifty(B), Fifty(K));
    const auto off = [](const One<Scalar>& is, const One<Fifty>& should_be) {
      return Fifty(abs(Fifty(is[0]) / should_be[0] - 1));
    };
    CHECK(off(step.impulse_response(), exact.impulse_response()) < tolerance);
    CHECK(off(step.step_response(), exact.step_response()) < tolerance);
    CHECK(off(step.ramp_response(), exact.ramp_response()) < tolerance);
    One<Scalar> x(Scalar(1)), v(Scalar(0)), none(Scalar(0));
    One<Fifty> x_exact(Fifty(1)), v_exact(Fifty(0)), none_exact(Fifty(0));
    step.advance(x, v, none, none);
    exact.advance(x_exact, v_exact, none_exact, none_exact);
    CHECK(abs(Fifty(x[0]) - x_exact[0]) < tolerance);
    CHECK(abs(Fifty(v[0]) - v_exact[0]) <= tolerance * abs(v_exact[0]));
  }
}

TEST_CASE_TEMPLATE("an axis with a long step beside short ones is as right as alone", Scalar, float, double) {
  const Scalar tolerance = 8 * std::numeric_limits<Scalar>::epsilon();  // 4 each
  const Eigen::Array<Scalar, 3, 1> kappa(Scalar(0.02), Scalar(0.2), Scalar(0)), beta(Scalar(0.4), Scalar(3), Scalar(0));
  for (int shift = 0; shift < 3; ++shift) {
    Eigen::Array<Scalar, 3, 1> k, b;
    for (int i = 0; i < 3; ++i) {
      k[i] = kappa[(i + shift) % 3];
      b[i] = beta[(i + shift) % 3];
    }
    SecondOrderStep<3, Scalar> step;
    step.set(k, b, Scalar(1));
    for (int i = 0; i < 3; ++i) {
      const auto alone = step_at<Scalar>(b[i], k[i]);
      CHECK(std::abs(step.step_response()[i] / alone.step_response()[0] - 1) <= tolerance);
      CHECK(std::abs(step.impulse_response()[i] / alone.impulse_response()[0] - 1) <= tolerance);
    }
  }
}

TEST_CASE("what is not finite in one axis is not finite in its answer, whatever the other axes are") {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {infinity, -infinity, nan}) {
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Array3d kappa(0.01, 0.02, 0.03), beta(0.1, 0.2, 0.3), x(1, 1, 1), v(0, 0, 0);
      (axis == 1 ? beta : kappa)[axis] = bad;
      SecondOrderStep<3> step;
      step.set(kappa, beta, 1);
      step.advance(x, v, v, v);
      CHECK(std::isnan(x[axis]));
    }
  }
}
