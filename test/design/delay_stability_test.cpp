// SPDX-License-Identifier: MIT
#include "design/delay_cases.hpp"

#include <limpid/design/delay_stability.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <stdexcept>

using limpid::delay_margin;
using limpid::delay_roots_right_of;
using limpid::delay_stable;
using limpid::DelaySystem;
using limpid::Gain;
using limpid::rightmost_delay_root;
using limpid::Tissue;
using limpid::Tool;
using limpid::test::DelayCase;
using limpid::test::draw_delay_case;
using limpid::test::tool;

namespace {

// The characteristic equation and the sizes that were added up in it.
double residual(const DelayCase& p, const std::complex<double>& s) {
  const double m = tool.mass, b = tool.damping + p.tissue.damping, k = tool.stiffness + p.tissue.stiffness;
  const std::complex<double> lag = std::exp(-s * p.system.delay);
  const double size =
      m * std::norm(s) + std::abs(b * s) + k + (std::abs(p.L[0]) + std::abs(p.L[1] * s)) * std::abs(lag);
  return std::abs(m * s * s + b * s + k - (p.L[0] + p.L[1] * s) * lag) / size;
}

}  // namespace

TEST_CASE("the rightmost root solves the equation, and nothing is to the right of it") {
  std::mt19937 generator(51);
  INFO("seed 51");
  for (int i = 0; i < 3'000; ++i) {
    const DelayCase p = draw_delay_case(generator);
    const auto root = rightmost_delay_root(p.system, p.tissue, p.L);
    CAPTURE(p.system.delay);
    CAPTURE(p.tissue.stiffness);
    CAPTURE(p.tissue.damping);
    CAPTURE(p.L);
    REQUIRE(residual(p, root) < 1e-12);
    const double near = 1e-6 * (std::abs(root) + 1 / p.system.delay);
    REQUIRE(delay_roots_right_of(p.system, p.tissue, p.L, root.real() + near) == 0);
    REQUIRE(delay_roots_right_of(p.system, p.tissue, p.L, root.real() - near) > 0);
    REQUIRE(delay_stable(p.system, p.tissue, p.L) == (root.real() < 0));
  }
}

TEST_CASE("at the delay margin a pair lies on the axis, below it none is to its right") {
  std::mt19937 generator(53);
  INFO("seed 53");
  int finite = 0;
  for (int i = 0; i < 2'000; ++i) {
    DelayCase p = draw_delay_case(generator);
    const double margin = delay_margin(tool, p.tissue, p.L);
    CAPTURE(p.L);
    CAPTURE(margin);
    if (margin == 0) {
      REQUIRE_FALSE(delay_stable<double>({tool, 0}, p.tissue, p.L));
      continue;
    }
    for (const double delay : {1e-4, 1e-3, 1e-2, 0.1, 1.0}) {
      if (delay < margin) REQUIRE(delay_stable<double>({tool, delay}, p.tissue, p.L));
    }
    if (std::isinf(margin)) continue;
    ++finite;
    p.system.delay = margin;
    const auto root = rightmost_delay_root(p.system, p.tissue, p.L);
    REQUIRE(std::abs(root.real()) < 1e-6 * std::abs(root));
    REQUIRE(delay_stable<double>({tool, margin * (1 - 1e-6)}, p.tissue, p.L));
    REQUIRE_FALSE(delay_stable<double>({tool, margin * (1 + 1e-6)}, p.tissue, p.L));
  }
  CHECK(finite > 200);
}

TEST_CASE_TEMPLATE("a first order limit has its root by Lambert's function", Scalar, double, long double) {
  // m s^2 + b s = L2 s exp(-s tau): s = 0 and m s + b = L2 exp(-s tau); with k > 0 small the second one stays near.
  // Exactly: L1 = 0, k = 0 has s tau = W(L2 tau / m exp(b tau / m)) - b tau / m, here with W(e) = 1.
  const Scalar m = Scalar(1), tau = Scalar(0.5), b = Scalar(1) / Scalar(4), L2 = std::exp(Scalar(1) - b * tau) / tau;
  const DelaySystem<Scalar> system{{m, Scalar(0), Scalar(0)}, tau};
  const auto root = rightmost_delay_root<Scalar>(system, {Scalar(0), b}, {Scalar(0), L2});
  CHECK(std::abs(root.real() - (Scalar(1) / tau - b)) < 64 * std::numeric_limits<Scalar>::epsilon());
  CHECK(root.imag() == 0);
}

TEST_CASE("without delay, and without gain, the roots are a quadratic's") {
  const Tissue<double> soft{999, 1.9}, hard{99, 19.9};  // -10 +- 99.5 i; -194.9, -5.13
  for (const double delay : {0.0, 0.02}) {
    const auto pair = rightmost_delay_root<double>({tool, delay}, soft, {0, 0});
    CHECK(pair.real() == doctest::Approx(-10).epsilon(1e-12));
    CHECK(pair.imag() == doctest::Approx(std::sqrt(9900.0)).epsilon(1e-12));
    const auto real = rightmost_delay_root<double>({tool, delay}, hard, {0, 0});
    CHECK(real.real() == doctest::Approx(-100 + std::sqrt(9000.0)).epsilon(1e-12));
    CHECK(real.imag() == 0);
  }
  const auto fed = rightmost_delay_root<double>({tool, 0}, soft, {-1000, -2});
  CHECK(fed.real() == doctest::Approx(-20).epsilon(1e-12));
  CHECK(fed.imag() == doctest::Approx(std::sqrt(20'000.0 - 400)).epsilon(1e-12));
}

TEST_CASE("a feedback weaker than the tissue at every frequency is stable for every delay") {
  CHECK(std::isinf(delay_margin<double>(tool, {1000, 60}, {-100, -1})));
  CHECK(delay_stable<double>({tool, 1000}, {1000, 60}, {-100, -1}));
}

TEST_CASE("a root at zero for every delay is no stability") {
  // kappa = l1: f(0) = 0
  const Tool<1> bare{.mass = 1, .damping = 0, .stiffness = 0};
  CHECK_FALSE(delay_stable<double>({bare, 0.1}, {1000, 30}, {1000, 0}));
  CHECK_FALSE(delay_stable<double>({bare, 0.1}, {0, 30}, {0, 0}));
}

TEST_CASE("a pair on the axis for every delay is no stability") {
  const Tool<1> bare{.mass = 1, .damping = 0, .stiffness = 0};
  for (const double delay : {0.0, 0.1}) CHECK_FALSE(delay_stable<double>({bare, delay}, {1000, 0}, {0, 0}));
}

TEST_CASE("an undamped pair that the delayed stiffness damps is counted once") {
  // -3.42 +- 69.1 i with the delay, on the axis without it
  const Tool<1> bare{.mass = 0.1, .damping = 0, .stiffness = 0};
  const Tissue<double> tissue{500, 0};
  const Gain<double> L{50, 0};
  CHECK(delay_roots_right_of<double>({bare, 0.016}, tissue, L, 0) == 0);
  CHECK(delay_roots_right_of<double>({bare, 0.0}, tissue, L, 0) == 0);
  CHECK(delay_stable<double>({bare, 0.016}, tissue, L));
  CHECK_FALSE(delay_stable<double>({bare, 0.0}, tissue, L));
  CHECK(rightmost_delay_root<double>({bare, 0.016}, tissue, L).real() == doctest::Approx(-3.42).epsilon(1e-2));
  CHECK(delay_margin<double>(bare, tissue, L) == 0);
  CHECK(delay_roots_right_of<double>({bare, 0.016}, tissue, {-50, 0}, 0) == 2);
}

TEST_CASE("with beta = l2 the count agrees with the rightmost root, whatever rounding does to the angle") {
  std::mt19937 generator(57);
  INFO("seed 57");
  const Tool<1> bare{.mass = 0.1, .damping = 0, .stiffness = 0};
  std::uniform_real_distribution<double> part(-0.9, 0.9), damping(0.01, 3), delay(0.001, 0.1);
  for (int i = 0; i < 1'000; ++i) {
    const Tissue<double> tissue{500, damping(generator)};
    const Gain<double> L{500 * part(generator), tissue.damping};
    const DelaySystem<double> system{bare, delay(generator)};
    CAPTURE(system.delay);
    CAPTURE(L);
    const auto root = rightmost_delay_root(system, tissue, L);
    REQUIRE(residual({{bare, system.delay}, {tissue.stiffness - 1, tissue.damping - 0.1}, L}, root) < 1e-12);
    REQUIRE(delay_stable(system, tissue, L) == (root.real() < 0));
    REQUIRE((delay_roots_right_of(system, tissue, L, 0.0) > 0) == (root.real() > 0));
  }
}

TEST_CASE("a delayed damping that equals the own one damps as the sign says, but not with a whole period") {
  // s^2 + beta s (1 - exp(-s delay)) + kappa
  const Tool<1> bare{.mass = 1, .damping = 0, .stiffness = 0};
  CHECK(delay_stable<double>({bare, 0.5}, {4, 1}, {0, 1}));
  CHECK_FALSE(delay_stable<double>({bare, std::acos(-1.0)}, {4, 1}, {0, 1}));
  CHECK_FALSE(delay_stable<double>({bare, 0.5}, {4, -1}, {0, -1}));
  CHECK(delay_roots_right_of<double>({bare, 0.5}, {4, -1}, {0, -1}, 0) == 2);
}

TEST_CASE("beside a root at zero, the real one that passes zero is counted") {
  // f(s)/s = s + beta - l2 exp(-s h) + l1 (1 - exp(-s h))/s, and f'(0) = beta - l2 + l1 h
  const Tool<1> bare{.mass = 1, .damping = 0, .stiffness = 0};
  const auto count = [&](double delay, const Tissue<double>& tissue, const Gain<double>& L) {
    return delay_roots_right_of<double>({bare, delay}, tissue, L, 0);
  };
  CHECK(count(0, {1, 1}, {1, 1.5}) == 1);
  CHECK(count(0.4, {1, 1}, {1, 1.5}) == 1);  // (l2 - beta)/l1 = 0.5, to the left
  CHECK(count(0.6, {1, 1}, {1, 1.5}) == 0);
  CHECK(count(0.9, {1, -3}, {1, -2}) == 1);  // 1, to the right
  CHECK(count(1.1, {1, -3}, {1, -2}) == 2);
  CHECK(count(0.5, {-1, 1}, {-1, 1}) == 1);
}

TEST_CASE("the count never falls on the way to the left, and is not known where it is too large") {
  const Tool<1> bare{.mass = 0.1, .damping = 0, .stiffness = 0};
  const DelaySystem<double> system{bare, 0.016};
  int before = 0;
  for (double abscissa = 0; abscissa > -1'200; abscissa -= 10) {
    const int count = delay_roots_right_of<double>(system, {500, 10}, {-300, -5}, abscissa);
    CAPTURE(abscissa);
    REQUIRE(count >= before);
    before = count;
  }
  for (const double abscissa : {-3e3, -1e4, -2e4, -2.1e4, -1e5}) {
    CHECK(delay_roots_right_of<double>(system, {500, 10}, {-300, -5}, abscissa) == -1);
  }
}

TEST_CASE("numbers too large to tell give an infinite root and no stability") {
  CHECK(rightmost_delay_root<double>({tool, 1}, {1e308, 1e308}, {1e308, 1e308}).real() ==
        std::numeric_limits<double>::infinity());
  CHECK_FALSE(delay_stable<double>({tool, 1}, {1e308, 1e308}, {1e308, 1e308}));
}

TEST_CASE("arguments that make no sense are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS((void)delay_stable<double>({tool, -1}, {1, 1}, {0, 0}), std::invalid_argument);
  CHECK_THROWS_AS((void)delay_stable<double>({tool, nan}, {1, 1}, {0, 0}), std::invalid_argument);
  CHECK_THROWS_AS((void)rightmost_delay_root<double>({tool, 1}, {nan, 1}, {0, 0}), std::invalid_argument);
  CHECK_THROWS_AS((void)rightmost_delay_root<double>({{.mass = 0}, 1}, {1, 1}, {0, 0}), std::invalid_argument);
  CHECK_THROWS_AS((void)delay_margin<double>(tool, {1, 1}, {nan, 0}), std::invalid_argument);
}

TEST_CASE("the unit of time does not matter, however small or large") {
  // s^2 + s/10 + 1 = -(9/10) exp(-3 s), in units of u seconds.
  const auto root = rightmost_delay_root<double>({{.mass = 1, .damping = 0.1, .stiffness = 1}, 3}, {0, 0}, {-0.9, 0});
  const double margin = delay_margin<double>({.mass = 1, .damping = 0.1, .stiffness = 1}, {0, 0}, {-0.9, 0});
  REQUIRE(root.real() > 0);
  for (const double u : {1e-150, 1e-100, 1e100, 1e150}) {
    CAPTURE(u);
    const Tool<1> scaled{.mass = 1, .damping = 0.1 / u, .stiffness = 1 / u / u};
    const DelaySystem<double> system{scaled, 3 * u};
    const Gain<double> L(-0.9 / u / u, 0);
    CHECK_FALSE(delay_stable<double>(system, {0, 0}, L));
    CHECK(delay_roots_right_of<double>(system, {0, 0}, L, 0.1 / u) == 2);
    CHECK(rightmost_delay_root<double>(system, {0, 0}, L).real() * u == doctest::Approx(root.real()).epsilon(1e-12));
    CHECK(delay_margin<double>(scaled, {0, 0}, L) / u == doctest::Approx(margin).epsilon(1e-12));
  }
}

TEST_CASE("a tool whose stiffness over its mass is no number is refused") {
  const Tool<1> extreme{.mass = 1e-300, .damping = 1, .stiffness = 1e300};
  CHECK_THROWS_WITH_AS((void)delay_margin<double>(extreme, {0, 0}, {-1e300, 0}),
                       "Tool: stiffness: expected finite over the mass, got 1e+300", std::invalid_argument);
}

TEST_CASE("where digits are lost to overflow or underflow no delay is called safe") {
  // L1 = -2 k in honey crosses the axis at 2e-200 rad/s: unstable at this delay.
  const DelaySystem<double> honey{{.mass = 1, .damping = 1, .stiffness = 1e-200}, 1e201};
  CHECK_FALSE(delay_stable<double>(honey, {0, 0}, {-2e-200, 0}));
  CHECK(delay_margin<double>(honey.tool, {0, 0}, {-2e-200, 0}) < 1e201);
  const DelaySystem<double> apart{{.mass = 1, .damping = 1e200, .stiffness = 1}, 1};
  CHECK(delay_roots_right_of<double>(apart, {0, 0}, {2, 0}, 0) == -1);
}
