// SPDX-License-Identifier: MIT
#include "design/palpation.hpp"
#include "design_instances.hpp"

#include <limpid/design/predictor_margin.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>

using limpid::Coordinates;
using limpid::Gain;
using limpid::Tissue;
using limpid::Verdict;
using limpid::test::design_at;

namespace {

const auto& box = limpid::test::box;
const auto& rates = limpid::test::rates;

std::span<const Tissue<>> one(const Tissue<>& tissue) { return {&tissue, 1}; }

}  // namespace

// 1 %: the figures of the notes have two to three digits.
TEST_CASE("margins at the printed gains are those of the notes") {
  const auto check = [](const limpid::PredictorMargin<>& m, double expected) {
    CHECK(m.verdict == Verdict::feasible);
    CHECK(m.margin == doctest::Approx(expected).epsilon(0.01));
    CHECK(m.bound == doctest::Approx(m.margin).epsilon(1e-6));
  };
  check(limpid::theorem2_margin<double>(design_at(1 / 60.0), Tissue<>{2000, 45}, Gain<>(-753.2, -17.01)), 0.0382);
  check(limpid::theorem3_margin<double>(design_at(1 / 60.0), Tissue<>{2000, 25}, Gain<>(-574.1, -7.260)), 0.0302);
  const Tissue<> middle{1100, 30};  // Table 6.4
  check(limpid::theorem3_margin<double>(design_at(0.016), middle, Gain<>(-441.3, -12.12)), 0.0217);
  check(limpid::theorem3_margin<double>(design_at(0.032), middle, Gain<>(-203.3, -5.15)), 0.0237);
  check(limpid::theorem3_margin<double>(design_at(0.1), middle, Gain<>(-195.1, -4.89)), 0.0146);
}

TEST_CASE("Theorem 5 on the whole box: margins of the notes, and infeasible at 0.1 s") {
  CHECK(limpid::theorem5_margin<double>(design_at(0.016, 0), box, rates).margin ==
        doctest::Approx(0.00658).epsilon(0.01));
  CHECK(limpid::theorem5_margin<double>(design_at(0.032, 0), box, rates).margin ==
        doctest::Approx(2.5e-4).epsilon(0.01));
  const auto slow = limpid::theorem5_margin<double>(design_at(0.1, 0), box, rates);
  CHECK(slow.verdict == Verdict::infeasible);
  CHECK(slow.bound < 0);
}

TEST_CASE("no single P, Q, R serves the whole box at the printed gains") {
  const Tissue<> corners[] = {{200, 20}, {2000, 20}, {200, 40}, {2000, 40}};
  const std::span<const Tissue<>> tissues(corners);
  const auto verdict = [&](double T_d, const Gain<>& L) {
    return limpid::printed_theorem3<double>(design_at(T_d), tissues, L).lmi.solve().verdict;
  };
  CHECK(verdict(0.016, {-441.3, -12.12}) == Verdict::infeasible);
  CHECK(verdict(0.032, {-203.3, -5.15}) == Verdict::infeasible);
  CHECK(verdict(0.1, {-195.1, -4.89}) == Verdict::infeasible);
}

TEST_CASE("in raw units no verdict is wrong: 87 cells on both sides of the notes' boundary") {
  const Gain<> L(-195.1, -4.89);  // at 0.1 s
  struct Row {
    double damping, boundary;
  };
  for (const Row& row : {Row{20, 191.8}, {30, 230}, {40, 284}}) {
    for (int i = 0; i < 29; ++i) {
      const Tissue<> tissue{181.0 + 5 * i, row.damping};
      CAPTURE(tissue.stiffness);
      CAPTURE(tissue.damping);
      const auto theorem = limpid::printed_theorem3<double>(design_at(0.1), one(tissue), L, Coordinates::raw);
      const bool expected = tissue.stiffness > row.boundary;
      CHECK(theorem.lmi.solve().verdict == (expected ? Verdict::feasible : Verdict::infeasible));
    }
  }
}

TEST_CASE("Theorem 3 is feasible exactly where Theorem 2 is") {
  const Gain<> L(-195.1, -4.89);
  for (const double stiffness : {200.0, 225.0, 235.0, 400.0}) {
    const Tissue<> tissue{stiffness, 30};
    CHECK(limpid::printed_theorem2<double>(design_at(0.1), one(tissue), L).lmi.solve().verdict ==
          limpid::printed_theorem3<double>(design_at(0.1), one(tissue), L).lmi.solve().verdict);
  }
}

TEST_CASE("a gain that was found holds, in either coordinates") {
  const Tissue<> tissue{1100, 30};
  for (const auto coordinates : {Coordinates::scaled, Coordinates::raw}) {
    const auto free = limpid::printed_theorem3<double>(design_at(0.032), one(tissue), std::nullopt, coordinates);
    const auto result = free.lmi.solve();
    REQUIRE(result.feasible());
    const Gain<> L = free.gain(result);
    CHECK(limpid::printed_theorem3<double>(design_at(0.032), one(tissue), L).lmi.solve().verdict == Verdict::feasible);
  }
}

TEST_CASE("an affine gain that was found for the box holds there") {
  const auto free = limpid::printed_theorem5<double>(design_at(0.016, 0), box, rates);
  const auto result = free.at_centre.lmi.solve();
  REQUIRE(result.feasible());
  const auto given = limpid::printed_theorem5<double>(design_at(0.016, 0), box, rates, free.gain(result));
  CHECK(given.at_centre.lmi.solve().verdict == Verdict::feasible);
}

TEST_CASE("nothing is proved of a gain that the six numbers do not come to") {
  const Tissue<> tissue{1100, 30};
  limpid::AffineGain<> L;
  L.L1 = {1e21 / 3300, 0};
  L.L0 = {-(L.L1[0] * 1100), 0};
  const double exact = std::fma(L.L1[0], 1100, L.L0[0]);
  REQUIRE(exact == 32512);
  REQUIRE(limpid::theorem3_margin<double>(design_at(0.016), tissue, Gain<>(exact, 0)).verdict == Verdict::infeasible);
  const auto affine = limpid::theorem5_margin<double>(design_at(0.016), {tissue, tissue}, {0, 0}, L);
  CHECK(affine.verdict != Verdict::feasible);
  CHECK(affine.margin <= 0);
}

TEST_CASE("a design that cannot be used is refused") {
  const Tissue<> tissue{1100, 30};
  CHECK_THROWS_AS((void)limpid::theorem3_margin<double>(design_at(0), tissue), std::invalid_argument);
  CHECK_THROWS_AS((void)limpid::theorem3_margin<double>(design_at(0.1), Tissue<>{-1, 30}), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS((void)limpid::theorem3_margin<double>(design_at(0.1), tissue, Gain<>(nan, 0)), std::invalid_argument);
  CHECK_THROWS_AS((void)limpid::theorem5_margin<double>(design_at(0.1), {{300, 20}, {200, 40}}, {1, 1}),
                  std::invalid_argument);
  CHECK_THROWS_AS((void)limpid::printed_theorem3<double>(design_at(0.1), std::span<const Tissue<>>{}),
                  std::invalid_argument);
}

TEST_CASE("an affine gain that is not finite is refused, and the row is named") {
  limpid::AffineGain<> L;
  L.L0[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS((void)limpid::theorem5_margin<double>(design_at(0.1), box, {1, 1}, L),
                       "AffineGain: L0: expected finite, got 0 nan", std::invalid_argument);
  L = {};
  L.L2[0] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS((void)limpid::printed_theorem5<double>(design_at(0.1), box, {1, 1}, L),
                       "AffineGain: L2: expected finite, got inf 0", std::invalid_argument);
}
