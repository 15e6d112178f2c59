// SPDX-License-Identifier: MIT
#include <robot/worst.hpp>
#include <support/maximum.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using limpid::test::Fifty;
using limpid::test::largest_entry;
using limpid::test::maximum;

TEST_CASE_TEMPLATE("a maximum with NaN is NaN, wherever it stands", Scalar, float, double, long double, Fifty) {
  const Scalar nan = std::numeric_limits<Scalar>::quiet_NaN(), one{1}, two{2};
  const auto is_nan = [](const Scalar& value) { return !(value <= 1 || value >= 1); };
  CHECK(maximum(one, two) == two);
  CHECK(maximum(two, one) == two);
  CHECK(is_nan(maximum(nan, one)));
  CHECK(is_nan(maximum(one, nan)));
  CHECK(is_nan(maximum(one, nan, two)));
  CHECK(is_nan(maximum(nan, one, two)));
  CHECK(is_nan(maximum(one, two, nan)));
  CHECK_FALSE(maximum(one, nan) < two);  // so that a bound on the worst error fails
}

TEST_CASE("the largest entry of what holds a NaN is NaN, wherever it stands") {
  CHECK(largest_entry(Eigen::Vector4d(1, -3, 2, 0)) == 3);
  for (int i = 0; i < 4; ++i) {
    Eigen::Vector4d of(1, -3, 2, 0);
    of[i] = std::numeric_limits<double>::quiet_NaN();
    CAPTURE(i);
    CHECK(std::isnan(largest_entry(of)));
    CHECK(std::isnan(largest_entry(of.array() - 1)));
  }
}

TEST_CASE("the worst of many trials stays NaN once one was") {
  limpid::test::Worst worst;
  worst.see(1, 0);
  worst.see(std::numeric_limits<double>::quiet_NaN(), 1);
  worst.see(2, 2);
  CHECK(std::isnan(worst.error()));
}
