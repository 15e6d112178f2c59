// SPDX-License-Identifier: MIT
#include <limpid/estimation/exponential_mean.hpp>
#include <support/maximum.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using limpid::test::Fifty;
using limpid::test::maximum;

TEST_CASE_TEMPLATE("the mean of exp is right to three roundings on both sides of its change of method", Scalar, float,
                   double, long double) {
  using Lane = Eigen::Array<Scalar, 1, 1>;
  std::mt19937 random(16);
  std::uniform_real_distribution<double> exponent(-30, 5), sign(-1, 1);
  Fifty worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Scalar x = Scalar(i < 1000 ? std::pow(2.0, exponent(random)) : 0.0625 + 0.01 * sign(random)) *
                     Scalar(sign(random) < 0 ? -1 : 1);
    const Fifty exact = Fifty(expm1(Fifty(x))) / Fifty(x);
    const Fifty error = abs(Fifty(limpid::exponential_mean(Lane(x))[0]) - exact) / exact;
    worst = maximum(worst, error);
  }
  CHECK(worst < 3 * Fifty(std::numeric_limits<Scalar>::epsilon()));
  CHECK(limpid::exponential_mean(Lane(Scalar{0}))[0] == Scalar{1});
}
