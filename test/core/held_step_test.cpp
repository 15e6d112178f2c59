// SPDX-License-Identifier: MIT
#include <limpid/core/held_step.hpp>
#include <limpid/core/inverse_factorial.hpp>

#include <doctest/doctest.h>

#include <cmath>

using limpid::held_step;

TEST_CASE("a held step of a decaying state is its exponential") {
  const auto step = held_step(Eigen::Matrix<double, 1, 1>(-3.0), 0.7);
  CHECK(step.Phi(0, 0) == doctest::Approx(std::exp(-2.1)).epsilon(1e-14));
  CHECK(step.Psi(0, 0) == doctest::Approx((1 - std::exp(-2.1)) / 3).epsilon(1e-14));
}

TEST_CASE("a held step of a double integrator, whose A is singular, is exact") {
  Eigen::Matrix2d A;
  A << 0, 1, 0, 0;
  const auto step = held_step(A, 0.25);
  CHECK(step.Phi == (Eigen::Matrix2d() << 1, 0.25, 0, 1).finished());
  CHECK(step.Psi == (Eigen::Matrix2d() << 0.25, 0.03125, 0, 0.25).finished());
}

TEST_CASE("a held step of a rotation turns by the angle, however many doublings it takes") {
  Eigen::Matrix2d A;
  A << 0, -1, 1, 0;
  const auto step = held_step(A, 10.0);  // five doublings, each of which doubles the rounding
  CHECK(std::abs(step.Phi(0, 0) - std::cos(10.0)) < 1e-14);
  CHECK(std::abs(step.Phi(1, 0) - std::sin(10.0)) < 1e-14);
}

TEST_CASE("inverse factorials are those of whole numbers") {
  CHECK(limpid::detail::inverse_factorial<double, 0>() == 1);
  CHECK(limpid::detail::inverse_factorial<double, 5>() == 1.0 / 120);
  CHECK(limpid::detail::inverse_factorial<float, 3>() == 1.0f / 6);
}
