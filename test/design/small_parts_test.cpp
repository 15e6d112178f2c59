// SPDX-License-Identifier: MIT
#include <limpid/design/balance.hpp>
#include <limpid/design/bracketed_root.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using limpid::detail::balanced;
using limpid::detail::balancing;
using limpid::detail::bracketed_root;
using limpid::detail::eigenvalues_of;

TEST_CASE("a bracketed root is found to rounding") {
  const double pi_half =
      bracketed_root<double>([](double x) { return std::cos(x); }, 1, std::cos(1.0), 2, std::cos(2.0));
  // cos has slope -1 there: the root is uncertain by the rounding of x
  CHECK(std::abs(pi_half - std::numbers::pi / 2) <= 2 * std::numeric_limits<double>::epsilon());
  const auto cubic = [](double x) { return x * x * x - 2; };
  CHECK(bracketed_root<double>(cubic, 0, -2, 8, 510) == doctest::Approx(std::cbrt(2.0)).epsilon(1e-15));
}

TEST_CASE("balancing scales by powers of two and keeps the eigenvalues") {
  Eigen::MatrixXd A(2, 2);
  A << 1, 1e12, 1e-12, 3;  // eigenvalues 2 +- sqrt(2)
  const auto d = balancing<double>(A);
  for (const double factor : d) CHECK(std::exp2(std::round(std::log2(factor))) == factor);
  const Eigen::MatrixXd B = balanced<double>(A);
  CHECK(std::max(B(0, 1), B(1, 0)) <= 4 * std::min(B(0, 1), B(1, 0)));
  auto values = eigenvalues_of<double>(A);
  REQUIRE(values.size() == 2);
  std::sort(values.begin(), values.end(), [](auto a, auto b) { return a.real() < b.real(); });
  CHECK(values[0].real() == doctest::Approx(2 - std::numbers::sqrt2).epsilon(1e-14));
  CHECK(values[1].real() == doctest::Approx(2 + std::numbers::sqrt2).epsilon(1e-14));
}

TEST_CASE("a matrix that is empty or not finite has no eigenvalues to give") {
  CHECK(eigenvalues_of<double>(Eigen::MatrixXd(0, 0)).empty());
  CHECK(eigenvalues_of<double>(Eigen::MatrixXd::Constant(2, 2, std::numeric_limits<double>::quiet_NaN())).empty());
}
