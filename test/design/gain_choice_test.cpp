// SPDX-License-Identifier: MIT
#include "design/palpation.hpp"
#include "design_instances.hpp"

#include <limpid/design/gain_choice.hpp>
#include <support/maximum.hpp>

#include <doctest/doctest.h>

#include <stdexcept>

using limpid::choose_gain;
using limpid::Gain;
using limpid::GainCriterion;
using limpid::PredictorDesign;
using limpid::Tissue;
using limpid::Verdict;
using limpid::test::design_at;
using limpid::test::maximum;

namespace {

const Tissue<> middle{1100, 30};

}  // namespace

TEST_CASE("the largest margin is that of its gain, and above the printed gain's and its neighbours'") {
  const auto choice = choose_gain(design_at(0.032), middle, GainCriterion::largest_margin);
  REQUIRE(choice.verdict == Verdict::feasible);
  const auto margin = [](const Gain<>& L) {
    return limpid::theorem3_margin<double>(design_at(0.032), middle, L).margin;
  };
  CHECK(margin(choice.gain) == doctest::Approx(choice.value).epsilon(1e-6));
  CHECK(choice.value > 0.0237);  // Table 6.4's
  for (const Gain<>& step : {Gain<>(1, 0), Gain<>(-1, 0), Gain<>(0, 0.1), Gain<>(0, -0.1)}) {
    CHECK(margin(choice.gain + step) <= choice.value * (1 + 1e-6));
  }
}

TEST_CASE("the smallest bound is that of its gain, and below its neighbours'") {
  const auto choice = choose_gain(design_at(0.016), middle, GainCriterion::smallest_bound);
  REQUIRE(choice.verdict == Verdict::feasible);
  const auto bound = [](const Gain<>& L) { return limpid::theorem3_error_bound(design_at(0.016), middle, L).by_force; };
  CHECK(bound(choice.gain) == doctest::Approx(choice.value).epsilon(1e-6));
  CHECK(choice.value < bound({-441.3, -12.12}));
  for (const Gain<>& step : {Gain<>(5, 0), Gain<>(-5, 0), Gain<>(0, 0.1), Gain<>(0, -0.1)}) {
    CHECK(bound(choice.gain + step) >= choice.value * (1 - 1e-6));
  }
}

TEST_CASE("the smallest sampled radius is the closed form's where Theorem 3 certifies its gain") {
  // Notes, best L at (1100, 30): radius .174, .085, .0047 at .016, .032, .1 s; the latter two cancel to two digits.
  const double expected[] = {0.174, 0.085, 0.0047}, T_d[] = {0.016, 0.032, 0.1};
  for (int i = 0; i < 3; ++i) {
    const auto choice = choose_gain(design_at(T_d[i]), middle, GainCriterion::smallest_sampled_radius);
    REQUIRE(choice.verdict == Verdict::feasible);
    CHECK(choice.value == doctest::Approx(expected[i]).epsilon(0.01));
  }
}

TEST_CASE("for several tissues the radius is the worst one's, and its gain is certified for all") {
  const Tissue<> tissues[] = {{900, 30}, {1300, 30}};
  const std::span<const Tissue<>> both(tissues);
  const auto choice = choose_gain<double>(design_at(0.016), both, GainCriterion::smallest_sampled_radius);
  REQUIRE(choice.verdict == Verdict::feasible);
  double worst = 0;
  for (const Tissue<>& tissue : tissues) {
    const limpid::SampledSystem<> system{.tool = design_at(0.016).tool, .period = 0.016, .delay = 0.016};
    worst = maximum(worst, limpid::sampled_radius(system, tissue, choice.gain));
  }
  CHECK(choice.value == worst);
  CHECK(limpid::verify_theorem3<double>(design_at(0.016), both, choice.gain).verdict == Verdict::feasible);
}

TEST_CASE("the choice depends on no path: a wider scalar and a design in other units give the same gain") {
  for (const auto criterion : {GainCriterion::largest_margin, GainCriterion::smallest_bound}) {
    const auto choice = choose_gain(design_at(0.016), middle, criterion);
    // Twice the mass, stiffness and damping: the same dynamics, twice the gain.
    const PredictorDesign<> twice{.tool = {.mass = 0.2, .damping = 0.2, .stiffness = 2}, .T_d = 0.016};
    const auto doubled = choose_gain(twice, Tissue<>{2200, 60}, criterion);
    CHECK((doubled.gain - 2 * choice.gain).norm() < 1e-4 * choice.gain.norm());
  }
}

TEST_CASE("where no gain is certified none is chosen") {
  // Notes: of margin exactly 0 at .1 s, (200, 32..40).
  const auto choice = choose_gain(design_at(0.1), Tissue<>{200, 40}, GainCriterion::largest_margin);
  CHECK(choice.verdict != Verdict::feasible);
  CHECK(!choice.reason.empty());
}

TEST_CASE("a design that cannot be used is refused") {
  CHECK_THROWS_AS((void)choose_gain(design_at(0), middle, GainCriterion::largest_margin), std::invalid_argument);
}
