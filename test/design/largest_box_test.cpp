// SPDX-License-Identifier: MIT
#include "design_instances.hpp"

#include <limpid/design/largest_certified_box.hpp>

#include <doctest/doctest.h>

#include <stdexcept>

using limpid::TissueBox;
using limpid::Verdict;

namespace {

const TissueBox<> whole{{200, 20}, {2000, 40}};

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
  const limpid::PredictorDesign<> design{.tool = {.mass = 0.1, .damping = 0.1, .stiffness = 0}, .T_d = 0.1};
  const auto largest = limpid::largest_box_theorem5(design, whole, {1.8e5, 2000});
  CHECK(largest.verdict == Verdict::feasible);
  CHECK(largest.scale == doctest::Approx(0.928).epsilon(0.01));
  CHECK(largest.not_beyond - largest.scale <= 1e-3);  // proved on both sides
}

TEST_CASE("one gain for all of the box: free it serves a larger box than a given one") {
  const limpid::PredictorDesign<> design{.tool = {.mass = 0.1, .damping = 0.1, .stiffness = 1}, .T_d = 0.016};
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
