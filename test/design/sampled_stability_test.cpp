// SPDX-License-Identifier: MIT
#include "design/palpation.hpp"

#include <limpid/design/sampled_stability.hpp>
#include <support/no_allocation.hpp>

#include <Eigen/LU>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

using limpid::Gain;
using limpid::sampled_radius;
using limpid::SampledStability;
using limpid::SampledSystem;
using limpid::Tissue;
using limpid::test::tool;

TEST_CASE("without feedback the radius is that of the tissue alone, whatever the delay") {
  // The slowest mode of the worst tissues of the notes' table: ke 200 and be 40 up to T = .1.
  const double T[] = {0.016, 0.032, 0.1, 0.2}, printed[] = {0.922, 0.850, 0.602, 0.362};
  for (int i = 0; i < 4; ++i) {
    const double beta = 401, kappa = 2010, slow = 2 * kappa / (beta + std::sqrt(beta * beta - 4 * kappa));
    const double exact = std::exp(-slow * T[i]);
    CHECK(std::abs(exact - printed[i]) < 6e-4);
    for (const double delay : {0.0, 0.3, 1.0, 1.6, 2.0}) {
      CAPTURE(delay);
      // Delays leave roots at zero, of a multiplicity that costs a general eigenvalue its digits but not this one.
      CHECK(sampled_radius<double>({tool, T[i], delay * T[i]}, {200, 40}, {0, 0}) ==
            doctest::Approx(exact).epsilon(1e-12));
    }
  }
}

TEST_CASE("the polynomial is that of the matrix, and Jury's conditions agree with its radius") {
  std::mt19937 generator(31);
  INFO("seed 31");
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(generator);
  };
  int unstable = 0;
  for (int i = 0; i < 3'000; ++i) {
    const double T = std::exp(uniform(-7, -1.5));
    const SampledSystem<double> system{tool, T, T * (i % 3 == 0 ? i % 4 : uniform(0, 3))};
    const Tissue<double> tissue{uniform(0, 2000), uniform(0, 50)};
    const Gain<double> L(uniform(-1500, 500), uniform(-20, 5));
    const SampledStability<double> stability(system);
    const double radius = stability.radius(tissue, L);
    CAPTURE(T);
    CAPTURE(system.delay);
    CAPTURE(L);
    // A polynomial of degree N is known by its values at N + 1 points.
    const auto p = stability.polynomial(tissue, L);
    const Eigen::MatrixXd M = stability.monodromy(tissue, L), I = Eigen::MatrixXd::Identity(M.rows(), M.rows());
    REQUIRE(p.size() == M.rows() + 1);
    for (int j = 0; j < p.size(); ++j) {
      const double z = -1.5 + 3.0 * j / double(p.size() - 1);
      double value = 0, size = 0;
      for (Eigen::Index k = p.size() - 1; k >= 0; --k) {
        value = value * z + p[k];
        size = size * std::abs(z) + std::abs(p[k]);
      }
      REQUIRE(std::abs((z * I - M).determinant() - value) < 1e-11 * (1 + size));
    }
    if (std::abs(radius - 1) > 1e-4) REQUIRE(stability.stable(tissue, L) == (radius < 1));
    REQUIRE(stability.stable(tissue, L, radius * 1.001));
    REQUIRE_FALSE(stability.stable(tissue, L, radius * 0.999));
    unstable += radius > 1;
  }
  CHECK(unstable > 300);
  CHECK(unstable < 2'700);
}

TEST_CASE("a delay of nearly a whole number of periods is no other than the whole number") {
  const Gain<double> L(-100, -1);
  for (const int n : {1, 2, 3}) {
    const double exact = sampled_radius<double>({tool, 0.125, 0.125 * n}, {600, 25}, L);
    for (const double off : {-1e-12, 1e-12}) {
      CHECK(sampled_radius<double>({tool, 0.125, 0.125 * n + off}, {600, 25}, L) ==
            doctest::Approx(exact).epsilon(1e-8));
    }
  }
  CHECK(SampledSystem<double>{tool, 0.1, 0.3}.fraction() < 0.1);  // 3 * 0.1 > 0.3 in double
  CHECK(sampled_radius<double>({tool, 0.1, 0.3}, {600, 25}, L) ==
        doctest::Approx(sampled_radius<double>({tool, 0.1, 3 * 0.1}, {600, 25}, L)).epsilon(1e-8));
}

TEST_CASE("hard data end in an infinite radius or the right one, never in an exception") {
  const SampledStability<double> stability({tool, 0.016, 0.016});
  CHECK(stability.radius({1e308, 1e308}, {1, 1}) > 0);
  CHECK(stability.radius({500, 20}, {1e308, 1e308}) > 1e100);
  CHECK_FALSE(stability.stable({500, 20}, {1e308, 1e308}));
  CHECK(stability.radius({0, 1e9}, {0, 0}) == doctest::Approx(1).epsilon(1e-9));     // a spring of 1 N/m in honey
  CHECK(stability.radius({-1, -0.1}, {0, 0}) == doctest::Approx(1).epsilon(1e-12));  // a free mass
}

TEST_CASE("a system that makes no sense is refused by the field's name") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Gain<double> L(0, 0);
  const auto refused = [&](const SampledSystem<double>& system, const Tissue<double>& tissue,
                           const Gain<double>& gain) {
    CHECK_THROWS_AS((void)sampled_radius(system, tissue, gain), std::invalid_argument);
  };
  refused({tool, 0, 0}, {1, 1}, L);
  refused({tool, nan, 0}, {1, 1}, L);
  refused({tool, 0.1, -0.1}, {1, 1}, L);
  refused({tool, 0.1, 3.2}, {1, 1}, L);
  refused({{.mass = -1}, 0.1, 0.1}, {1, 1}, L);
  refused({tool, 0.1, 0.1}, {nan, 1}, L);
  refused({tool, 0.1, 0.1}, {1, nan}, L);
  refused({tool, 0.1, 0.1}, {1, 1}, {nan, 0});
  CHECK_THROWS_WITH_AS(SampledStability<double>({tool, -1, 0}),
                       "SampledSystem: period: expected finite and > 0, got -1", std::invalid_argument);
}

TEST_CASE("with a delay of up to a period nothing is allocated") {
  const SampledStability<double> whole({tool, 0.016, 0.016}), part({tool, 0.016, 0.01});
  double sum = 0;
  limpid::test::check_no_allocation([&] {
    sum += whole.radius({600, 25}, {-100, -1}) + part.radius({600, 25}, {-100, -1});
    sum += whole.stable({600, 25}, {-100, -1}) ? 1 : 0;
  });
  CHECK(sum > 0);
}

TEST_CASE("a radius that is a subnormal number, or none, comes to an end") {
  // The slow mode of s^2 + 1e6 s + r 1e6 is exp(-r) after a second: 5e-324 at r = 744.4.
  for (const double r : {700.0, 735.0, 740.0, 744.0, 745.0}) {
    CAPTURE(r);
    const SampledSystem<double> system{{.mass = 1, .damping = 1e6, .stiffness = r * 1e6}, 1, 2.5};
    CHECK(sampled_radius<double>(system, {0, 0}, {0, 0}) == doctest::Approx(std::exp(-r)).epsilon(0.01));
  }
}

TEST_CASE("nothing is stable below a bound that is not above zero") {
  const SampledStability<double> stability({tool, 0.016, 0.016});
  REQUIRE(stability.stable({500, 20}, {0, 0}));
  for (const double bound : {0.0, -1.0, -2.0, std::numeric_limits<double>::quiet_NaN()}) {
    CAPTURE(bound);
    CHECK_FALSE(stability.stable({500, 20}, {0, 0}, bound));
  }
}
