// SPDX-License-Identifier: MIT
#include <limpid/signal/quantiser.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <limits>

using limpid::Quantiser;
using limpid::Status;

TEST_CASE_TEMPLATE("each axis is rounded to the nearest multiple of its step, halves away from zero", Scalar, float,
                   double, long double) {
  Quantiser<4, Scalar> quantiser({.step = {Scalar(0.5), Scalar(0.5), Scalar(0.5), Scalar(4)}});
  const auto [value, status] = quantiser.update({Scalar(0.74), Scalar(-0.75), Scalar(0.25), Scalar(-1.99)});
  CHECK(value[0] == Scalar(0.5));  // exact in binary
  CHECK(value[1] == Scalar(-1));
  CHECK(value[2] == Scalar(0.5));
  CHECK(value[3] == Scalar(0));
  CHECK(status == Status::ok);
}

TEST_CASE("an encoder's value is at most half a step away, and a level stays where it is") {
  Quantiser<1> encoder({.step = Eigen::Array<double, 1, 1>(4e-4)});
  for (int i = -1000; i <= 1000; ++i) {
    CAPTURE(i);
    const Eigen::Array<double, 1, 1> angle(i * 1.234e-3);
    const Eigen::Array<double, 1, 1> level = encoder.update(angle).value;
    // a level near 1.2 rad is rounded by half an ulp of it
    REQUIRE(std::abs(level[0] - angle[0]) <= 2e-4 + std::numeric_limits<double>::epsilon());
    REQUIRE(encoder.update(level).value[0] == level[0]);
  }
}

TEST_CASE("a non-finite axis keeps its last good value, says so, and leaves the others alone") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    Quantiser<2> quantiser({.step = {1, 1}});
    (void)quantiser.update({3.2, 5.1});
    const auto [value, status] = quantiser.update({bad, 7.4});
    CHECK(value[0] == 3);
    CHECK(value[1] == 7);
    CHECK(status == Status::not_finite);
  }
}

TEST_CASE("a value whose level is beyond the scalar stays as it is") {
  Quantiser<2> quantiser({.step = {1e-10, 1.7e308 / 1.5}});
  const auto [value, status] = quantiser.update({1e300, 1.79e308});
  CHECK(value[0] == 1e300);
  CHECK(value[1] == 1.79e308);
  CHECK(status == Status::ok);
}

TEST_CASE("no call allocates") {
  Quantiser<3> quantiser({.step = {1, 1, 1}});
  limpid::test::check_no_allocation([&] { (void)quantiser.update({1.5, 2.5, 3.5}); });
}

TEST_CASE("a step that cannot be one is refused") {
  CHECK_THROWS_WITH_AS(Quantiser<2>({.step = {1, 0}}), "Quantiser: step: expected finite and > 0, got 1 0",
                       std::invalid_argument);
}
