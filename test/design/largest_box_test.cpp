// SPDX-License-Identifier: MIT
#include "design/palpation.hpp"
#include "design_instances.hpp"

#include <limpid/design/largest_certified_box.hpp>

#include <doctest/doctest.h>

#include <stdexcept>

using limpid::TissueBox;
using limpid::Verdict;

namespace {

const TissueBox<>& whole = limpid::test::box;

}  // namespace

TEST_CASE("a known boundary is found to the tolerance, from below and above") {
  const auto decide = [](const TissueBox<>& box) {
    return box.upper.stiffness < 1100 + 900 * 0.7 ? Verdict::feasible : Verdict::infeasible;
  };
  const auto largest = limpid::largest_box<double>(whole, decide);
  CHECK(largest.verdict == Verdict::feasible);
  CHECK(largest.scale < 0.7);
  CHECK(largest.not_beyond >= 0.7);
  CHECK(largest.not_beyond - largest.scale <= 1e-3);
  CHECK(largest.box.upper.stiffness == 1100 + 900 * largest.scale);
}

TEST_CASE("where the whole box is feasible nothing else is tried; where none is, none is given") {
  const auto all = limpid::largest_box<double>(whole, [](const auto&) { return Verdict::feasible; });
  CHECK(all.scale == 1);
  CHECK(all.boxes == 1);
  const auto none = limpid::largest_box<double>(whole, [](const auto&) { return Verdict::infeasible; });
  CHECK(none.verdict == Verdict::infeasible);
  CHECK(none.scale == 0);
  const auto unknown = limpid::largest_box<double>(whole, [](const auto&) { return Verdict::undecided; });
  CHECK(unknown.verdict == Verdict::undecided);
  CHECK(unknown.not_beyond > 1);
}

TEST_CASE("Theorem 5 at 0.1 s: the largest box about (1100, 30) is .928 of the whole") {
  const auto design = limpid::test::design_at(0.1, 0);
  const auto largest = limpid::largest_box_theorem5(design, whole, limpid::test::rates);
  CHECK(largest.verdict == Verdict::feasible);
  CHECK(largest.scale == doctest::Approx(0.928).epsilon(0.01));
  CHECK(largest.not_beyond - largest.scale <= 1e-3);  // proved on both sides
}

TEST_CASE("one gain for all of the box: free it serves a larger box than a given one") {
  const auto design = limpid::test::design_at(0.016);
  const auto given = limpid::largest_box_theorem3(design, whole, limpid::Gain<>(-441.3, -12.12));  // Table 6.4
  const auto free = limpid::largest_box_theorem3(design, whole);
  CHECK(given.verdict == Verdict::feasible);
  CHECK(given.scale < 1);  // notes: no single P, Q, R serves the whole box at the printed gains
  CHECK(given.not_beyond - given.scale <= 1e-3);
  CHECK(free.scale >= given.scale);
}

TEST_CASE("what cannot be used is refused") {
  const auto decide = [](const auto&) { return Verdict::feasible; };
  CHECK_THROWS_AS((void)limpid::largest_box<double>({{300, 20}, {200, 40}}, decide), std::invalid_argument);
  CHECK_THROWS_AS((void)limpid::largest_box<double>(whole, decide, {.most = 0}), std::invalid_argument);
}

TEST_CASE("a tolerance below rounding, and a scale that is the largest number, come to an end") {
  const auto decide = [](const TissueBox<>& box) {
    return box.upper.stiffness < 0.8 ? Verdict::feasible : Verdict::infeasible;  // scale 0.6
  };
  const auto fine = limpid::largest_box<double>({{0, 0}, {1, 1}}, decide, {.tolerance = 1e-300});
  CHECK(fine.scale == doctest::Approx(0.6).epsilon(1e-15));
  const auto far = limpid::largest_box<double>({{0, 0}, {1, 1}}, decide, {.most = 1e308});
  CHECK(far.scale == doctest::Approx(0.6).epsilon(2e-3));
}
