// SPDX-License-Identifier: MIT
#include "design/palpation.hpp"

#include <limpid/design/sampled_proof.hpp>
#include <limpid/design/sampled_stability.hpp>
#include <limpid/design/sampled_worst.hpp>
#include <support/maximum.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

using limpid::Gain;
using limpid::prove_sampled_stability;
using limpid::SampledStability;
using limpid::SampledSystem;
using limpid::Tissue;
using limpid::TissueBox;
using limpid::Verdict;
using limpid::worst_sampled_radius;
using limpid::test::maximum;
using limpid::test::tool;

namespace {

const auto& box = limpid::test::box;

}  // namespace

TEST_CASE_TEMPLATE("the radius is proved over the box just above its worst, and disproved just below it", Scalar,
                   double, long double) {
  // Without feedback the worst is the slow mode at (200, 40), in closed form.
  const Scalar beta = Scalar(401), kappa = Scalar(2010), T = Scalar(0.016);
  const Scalar worst = std::exp(-2 * kappa / (beta + std::sqrt(beta * beta - 4 * kappa)) * T);
  const SampledSystem<Scalar> system{{Scalar(0.1), Scalar(0.1), Scalar(1)}, T, T};
  const TissueBox<Scalar> all{{200, 20}, {2000, 40}};
  const Gain<Scalar> none(0, 0);
  CHECK(prove_sampled_stability(system, all, none, worst * (1 + Scalar(1e-9))).proved());
  const auto below = prove_sampled_stability(system, all, none, worst * (1 - Scalar(1e-9)));
  CHECK(below.verdict == Verdict::infeasible);
  CHECK(below.tissue.stiffness == doctest::Approx(200).epsilon(1e-6));
  CHECK(below.tissue.damping == doctest::Approx(40).epsilon(1e-6));
}

TEST_CASE("the counterexample's tissues are proved to be unstable, and its box by one of them") {
  const SampledSystem<double> system{tool, 1.0 / 60, 1.0 / 60};
  const Gain<double> L(-753.2, -17.01);
  for (const double k_e : {400.0, 500.0, 600.0, 700.0}) {
    CHECK(prove_sampled_stability(system, Tissue<double>{k_e, 20}, L).verdict == Verdict::infeasible);
  }
  CHECK(prove_sampled_stability(system, Tissue<double>{2000, 20}, L).proved());
  const auto proof = prove_sampled_stability(system, box, L);
  REQUIRE(proof.verdict == Verdict::infeasible);
  CHECK(limpid::sampled_radius(system, proof.tissue, L) > 1);
}

TEST_CASE("verdicts at points agree with 2000 random radii, for any delay") {
  std::mt19937 generator(32);
  INFO("seed 32");
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(generator);
  };
  for (int i = 0; i < 2'000; ++i) {
    const double T = std::exp(uniform(-7, -1.5));
    const SampledSystem<double> system{tool, T, T * (i % 3 == 0 ? i % 4 : uniform(0, 3))};
    const Tissue<double> tissue{uniform(0, 2000), uniform(0, 50)};
    const Gain<double> L(uniform(-1500, 500), uniform(-20, 5));
    const double radius = limpid::sampled_radius(system, tissue, L);
    CAPTURE(T);
    CAPTURE(system.delay);
    CAPTURE(L);
    CAPTURE(radius);
    // Near-double roots let the conditions come as the square of the distance to their bound.
    REQUIRE(prove_sampled_stability(system, tissue, L, radius * 1.001).proved());
    REQUIRE(prove_sampled_stability(system, tissue, L, radius * 0.999).verdict == Verdict::infeasible);
  }
}

TEST_CASE("no tissue of a proved box has a larger radius") {
  std::mt19937 generator(33);
  INFO("seed 33");
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(generator);
  };
  for (int i = 0; i < 12; ++i) {
    const double T = std::exp(uniform(-5, -2));
    const SampledSystem<double> system{tool, T, T * (i % 2 == 0 ? 1 : uniform(0, 2))};
    const Gain<double> L(uniform(-300, 0) * 0.02 / T, uniform(-2, 0));
    const auto worst = worst_sampled_radius(system, box, L);
    CAPTURE(T);
    CAPTURE(L);
    REQUIRE(worst.proof.proved());
    CHECK(worst.proved <= worst.found * (1 + 1.01e-4));
    const SampledStability<double> stability(system);
    CHECK(stability.radius(worst.tissue, L) == doctest::Approx(worst.found).epsilon(1e-12));
    double most = 0;
    for (int j = 0; j < 2'000; ++j) most = maximum(most, stability.radius({uniform(200, 2000), uniform(20, 40)}, L));
    CHECK(most <= worst.proved);
  }
}

TEST_CASE(
    "what cannot be decided is left undecided: a bound that is the radius itself, too few cells, absurd numbers") {
  const SampledSystem<double> system{tool, 0.016, 0.016};
  const Gain<double> none(0, 0);
  const double radius = limpid::sampled_radius(system, Tissue<double>{200, 40}, none);
  CHECK(prove_sampled_stability(system, Tissue<double>{200, 40}, none, radius).verdict == Verdict::undecided);
  const auto few = prove_sampled_stability(system, box, none, 0.95, 3);
  CHECK(few.verdict == Verdict::undecided);
  CHECK(few.cells == 3);
  CHECK_FALSE(few.reason.empty());
  CHECK_FALSE(prove_sampled_stability(system, box, {1e308, 1e308}).proved());
  CHECK_FALSE(prove_sampled_stability(system, {{200, 20}, {1e308, 40}}, none, 1.0, 1'000).proved());
  CHECK_FALSE(prove_sampled_stability(system, box, none, 1e-300, 100).proved());
}

TEST_CASE("an unstable plant and one without stiffness are judged rightly") {
  const SampledSystem<double> system{{.mass = 0.1, .damping = 0, .stiffness = 0}, 0.02, 0.02};
  CHECK(prove_sampled_stability(system, Tissue<double>{-5, 1}, Gain<double>(0, 0)).verdict == Verdict::infeasible);
  CHECK(prove_sampled_stability(system, {{-0.5, 1}, {0.5, 2}}, Gain<double>(-20, -1)).proved());
  CHECK(prove_sampled_stability(system, {{0, 1}, {0, 2}}, Gain<double>(-20, -1)).proved());
}

TEST_CASE("arguments that make no sense are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const SampledSystem<double> system{tool, 0.016, 0.016};
  const Gain<double> L(0, 0);
  CHECK_THROWS_AS((void)prove_sampled_stability(system, {{2000, 20}, {200, 40}}, L), std::invalid_argument);
  CHECK_THROWS_AS((void)prove_sampled_stability(system, box, {nan, 0}), std::invalid_argument);
  CHECK_THROWS_AS((void)prove_sampled_stability(system, box, L, 0.0), std::invalid_argument);
  CHECK_THROWS_AS((void)prove_sampled_stability(system, box, L, 1.0, 0), std::invalid_argument);
  CHECK_THROWS_AS((void)worst_sampled_radius({tool, 0, 0}, box, L), std::invalid_argument);
}
