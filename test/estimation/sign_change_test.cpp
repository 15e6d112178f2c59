// SPDX-License-Identifier: MIT
#include <limpid/estimation/sign_change.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using limpid::detail::sign_change;

TEST_CASE("a sign change on a parabola is found to 1e-9 of the step, on its far side") {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < 1000; ++i) {
    CAPTURE(i);
    // height(t) = a (t - first)(t - second), the first root within the step, the second beyond it
    const double length = 1e-3, first = length * unit(generator), second = length * (1 + 3 * unit(generator));
    const double a = unit(generator) < 0.5 ? 1e4 : -1e4;
    const auto height = [&](double t) { return a * (t - first) * (t - second); };
    const auto found = sign_change(
        length, a > 0, [](double part) { return part; }, height);
    REQUIRE(found.changed);
    CHECK(found.part >= first);
    CHECK(found.part - first <= 1e-9 * length + 1e-15);
    CHECK(found.end == found.part);
  }
}

TEST_CASE("a step without a sign change is whole") {
  const auto found = sign_change(
      2.0, true, [](double part) { return part; }, [](double t) { return 1 + t; });
  CHECK(!found.changed);
  CHECK(found.part == 2);
  CHECK(found.end == 2);
}
