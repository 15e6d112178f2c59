// SPDX-License-Identifier: MIT
#include <limpid/estimation/least_squares_flow.hpp>
#include <support/maximum.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using limpid::InformationSeries;
using limpid::test::Fifty;
using limpid::test::maximum;

namespace {

/// The equation's left side over z, less 1: zero at the root l = ln(1 + z E).
template <typename Scalar>
double miss(const Scalar& E, const Scalar& z_of, const Scalar& q_of, const Scalar& p_of) {
  const Fifty z(z_of), q(q_of), p(p_of), l = log1p(z * Fifty(E));
  const Fifty slow = p > 0 ? Fifty(expm1(p * l) / p) : l;
  return static_cast<double>((q * (exp(l) - exp(p * l)) / (1 - p) + (1 - q) * slow) / z - 1);
}

}  // namespace

TEST_CASE_TEMPLATE("the series solves the equation of the information to a few roundings", Scalar, float, double) {
  using Array = Eigen::Array<Scalar, 4, 1>;
  const Scalar rounding = std::numeric_limits<Scalar>::epsilon() / 2;
  constexpr unsigned seed = 71;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<Scalar> uniform(0, 1);
  double worst = 0;
  for (int i = 0; i < 500; ++i) {
    const Scalar p = i % 5 == 0 ? Scalar{0} : Scalar(uniform(random) * Scalar(0.99));
    const InformationSeries<Array> series(p);
    Array z, q;
    for (int lane = 0; lane < 4; ++lane) {
      z[lane] = series.most() * (lane == 0 ? Scalar{1} : uniform(random));
      q[lane] = lane == 1 ? Scalar{1} : uniform(random) + std::numeric_limits<Scalar>::min();
    }
    const Array E = series(z, q);
    for (int lane = 0; lane < 4; ++lane) {
      if (z[lane] > Scalar{0}) worst = maximum(worst, std::abs(miss(E[lane], z[lane], q[lane], p)) / double(rounding));
    }
  }
  MESSAGE("worst in roundings: " << worst);
  CHECK(worst <= 4);  // of the last sum and product, of the largest coefficient, and the term left out
}

TEST_CASE("without normalisation the series is the geometric closed form") {
  // nu = 0: q = 1, p = 0, so that exp(l) - 1 = z and E = 1
  using Array = Eigen::Array<double, 1, 1>;
  const InformationSeries<Array> series(0);
  CHECK(series.most() > 0);
  const Array E = series(Array::Constant(series.most()), Array::Ones());
  CHECK(E[0] == doctest::Approx(1).epsilon(4e-16));  // four roundings: the coefficients cancel
}

TEST_CASE("the series is there for z of a tick of 1 ms in a tissue that is known") {
  // p = alpha nu of the thesis; a persistently excited gain has z of 2e-3 (alpha tau / (1 - p))
  CHECK(InformationSeries<Eigen::Array<double, 1, 1>>(0.02).most() > 0.015);
  CHECK(InformationSeries<Eigen::Array<float, 1, 1>>(0.02F).most() > 0.03F);
}

TEST_CASE("a scalar of more digits has no series, and iterates") {
  CHECK_FALSE(InformationSeries<Eigen::Array<long double, 1, 1>>::exists);
  CHECK_FALSE(InformationSeries<Eigen::Array<Fifty, 1, 1>>::exists);
}
