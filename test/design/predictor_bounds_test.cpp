// SPDX-License-Identifier: MIT
#include "design/palpation.hpp"
#include "design_instances.hpp"

#include <limpid/design/adaptation_rate.hpp>
#include <limpid/design/predictor_bounds.hpp>
#include <support/maximum.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

using limpid::DisturbanceEntry;
using limpid::Gain;
using limpid::PredictorDesign;
using limpid::Tissue;
using limpid::Verdict;
using limpid::test::maximum;

namespace {

const auto& box = limpid::test::box;
const PredictorDesign<> case2 = limpid::test::design_at(1 / 60.0);

}  // namespace

// The notes' figures: of ||e|| (not squared) by ||Delta_T||, in raw units, m and m/s mixed.
TEST_CASE("case 2: the bound (4.32) is 5742, and 37.8 where the disturbance enters as a force") {
  const Tissue<> tissue{2000, 25};
  const Gain<> L(-574.1, -7.260);
  const auto printed = limpid::theorem3_error_bound(case2, tissue, L, DisturbanceEntry::printed);
  REQUIRE(printed.verdict == Verdict::feasible);
  CHECK(printed.by_sampling == doctest::Approx(5742).epsilon(1e-4));
  CHECK(printed.least_by_sampling == doctest::Approx(printed.by_sampling).epsilon(1e-6));
  const auto tight = limpid::theorem3_error_bound(case2, tissue, L);
  REQUIRE(tight.verdict == Verdict::feasible);
  CHECK(tight.by_sampling == doctest::Approx(37.8).epsilon(1e-3));
  CHECK(tight.by_sampling == doctest::Approx(tight.by_force * L.norm()).epsilon(1e-12));
}

TEST_CASE("no bound is below what a constant force does to the error") {
  // At rest e = force/(k_t + k_e - L1): one of the disturbances the bound is for.
  const Tissue<> tissue{2000, 25};
  const Gain<> L(-574.1, -7.260);
  CHECK(limpid::theorem3_error_bound(case2, tissue, L).by_force >= 1 / (2001 + 574.1));
}

TEST_CASE("without feedback the bound covers the known gain of the tool in the tissue") {
  // L = 0: e = w/(m s^2 + b s + k); |(1, i w)|/|k - m w^2 + i b w| is largest near the resonance.
  const Tissue<> tissue{200, 20};
  double largest = 0;
  for (double w = 0; w < 200; w += 0.01) {
    const double real = 201 - 0.1 * w * w, imaginary = 20.1 * w;
    largest = maximum(largest, std::sqrt((1 + w * w) / (real * real + imaginary * imaginary)));
  }
  const auto bound = limpid::theorem3_error_bound(case2, tissue, Gain<>(0, 0));
  REQUIRE(bound.verdict == Verdict::feasible);
  CHECK(bound.by_force >= largest);
  CHECK(bound.by_sampling == 0);
}

TEST_CASE("(4.52) has the factor 2 of its cross term") {
  limpid::ErrorBound<> bound;
  bound.by_sampling = 3;
  bound.by_force = 4;
  CHECK(bound.together(1, 1) == std::sqrt(50.0));
  CHECK(bound.together(1, 1) >= 3 + 4 - 1e-12);  // what the two can come to when aligned
}

TEST_CASE("Theorem 5's bound is the tighter one's, and no smaller than that of one tissue") {
  PredictorDesign<> design = case2;
  design.T_d = 0.016;
  design.tool.stiffness = 0;
  const auto& rates = limpid::test::rates;
  const auto theorem = limpid::printed_theorem5<double>(design, box, rates);
  const auto result = theorem.at_centre.lmi.solve();
  REQUIRE(result.feasible());
  const limpid::AffineGain<> L = theorem.gain(result);
  const auto printed = limpid::theorem5_error_bound(design, box, rates, L, DisturbanceEntry::printed);
  const auto tight = limpid::theorem5_error_bound(design, box, rates, L);
  REQUIRE(printed.verdict == Verdict::feasible);
  REQUIRE(tight.verdict == Verdict::feasible);
  CHECK(tight.by_sampling < printed.by_sampling);
  const auto centre = limpid::theorem3_error_bound(design, box.centre(), L(box.centre()));
  CHECK(tight.by_force >= centre.by_force * (1 - 1e-6));
}

TEST_CASE("the bound is of the gain that the six numbers come to, not of their rounded sum") {
  PredictorDesign<> design = case2;
  design.T_d = 0.016;
  const Tissue<> tissue{1100, 30};
  for (const double size : {1e10, 1e13, 1e16, 1e21}) {
    CAPTURE(size);
    limpid::AffineGain<> L;
    L.L1 = {size / 3300, 0};
    L.L0 = {-(L.L1[0] * 1100), 0};
    const Gain<> exact(std::fma(L.L1[0], 1100, L.L0[0]), 0);
    REQUIRE(exact[0] != 0);
    const auto bound = limpid::theorem5_error_bound(design, {tissue, tissue}, {0, 0}, L);
    if (size < 1e15) CHECK(bound.verdict == Verdict::feasible);
    const auto least = limpid::theorem3_error_bound(design, tissue, exact);
    CHECK(bound.by_sampling >= least.least_by_sampling);
    CHECK(bound.by_force >= least.by_force * (1 - 1e-6));
    CHECK(bound.least_by_sampling <= least.by_sampling);
  }
}

TEST_CASE("(4.28): the hold adds at most the period times both speeds") {
  const auto bound = limpid::sampling_error_bound(0.5, 1.0, 2.0, 4.0, 8.0);
  CHECK(bound[0] == 1.5);
  CHECK(bound[1] == 6);
  CHECK_THROWS_AS((void)limpid::sampling_error_bound(0.0, 1.0, 1.0, 1.0, 1.0), std::invalid_argument);
  CHECK_THROWS_AS((void)limpid::sampling_error_bound(0.5, -1.0, 1.0, 1.0, 1.0), std::invalid_argument);
}

TEST_CASE("(6.2) gives the rates of 6.2.1 for large signals") {
  const limpid::AdaptationLimits<> limits{.rho_M = 5e9, .nu = 0.01, .phi_max = 0.05};
  const auto rates = limpid::adaptation_rates(limits, box);
  CHECK(rates.stiffness == doctest::Approx(1.8e5).epsilon(1e-3));
  CHECK(rates.damping == doctest::Approx(2000).epsilon(1e-3));
}

TEST_CASE("a box of one point has no rates, whatever the bound of phi") {
  const double infinity = std::numeric_limits<double>::infinity();
  const limpid::AdaptationLimits<double> limits{.rho_M = 1e3, .nu = 1, .phi_max = infinity};
  const limpid::TissueBox<double> point{{500, 30}, {500, 30}}, flat{{500, 30}, {500, 40}};
  const auto none = limpid::sure_adaptation_rates(limits, point);
  CHECK(none.stiffness == 0);
  CHECK(none.damping == 0);
  CHECK(limpid::sure_adaptation_rates(limits, flat).damping == infinity);
}

TEST_CASE("what the adaptation does stays below the sure rates, but not below (6.2)'s damping") {
  const limpid::AdaptationLimits<> limits{.rho_M = 5e9, .nu = 0.01, .phi_max = 0.05};
  const auto printed = limpid::adaptation_rates(limits, box), sure = limpid::sure_adaptation_rates(limits, box);
  double fastest_stiffness = 0, fastest_damping = 0;
  for (int i = 0; i < 360; ++i) {  // Gamma = rho_M I, phi on the circle, theta~ in the corner
    const double angle = 2 * 3.141592653589793 * i / 360, x = 0.05 * std::cos(angle), v = 0.05 * std::sin(angle);
    const double epsilon = x * 1800 + v * 20, gain = 5e9 / (1 + 0.01 * 5e9 * 0.05 * 0.05);
    fastest_stiffness = std::max(fastest_stiffness, std::abs(gain * x * epsilon));
    fastest_damping = std::max(fastest_damping, std::abs(gain * v * epsilon));
  }
  CHECK(fastest_stiffness < sure.stiffness);
  CHECK(fastest_damping < sure.damping);
  CHECK(fastest_damping > 10 * printed.damping);
}

TEST_CASE("what cannot be used is refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS((void)limpid::theorem3_error_bound(case2, Tissue<>{2000, 25}, Gain<>(nan, 0)), std::invalid_argument);
  CHECK_THROWS_AS((void)limpid::adaptation_rates<double>({.rho_M = 0, .nu = 1, .phi_max = 1}, box),
                  std::invalid_argument);
}
