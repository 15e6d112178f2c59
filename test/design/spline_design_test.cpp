// SPDX-License-Identifier: MIT
#include "design_instances.hpp"

#include <limpid/design/largest_box.hpp>
#include <limpid/design/spline_design.hpp>
#include <limpid/prediction/gain_table.hpp>

#include <doctest/doctest.h>

#include <stdexcept>

using limpid::design_spline;
using limpid::KnotGrid;
using limpid::TissueBox;
using limpid::Verdict;

namespace {

const TissueBox<> whole{{200, 20}, {2000, 40}};
const limpid::TissueRates<> rates{1.8e5, 2000};
const limpid::PredictorDesign<> slow{.tool = {.mass = 0.1, .damping = 0.1, .stiffness = 0}, .T_d = 0.1};

}  // namespace

TEST_CASE("at .93 of the box no affine gain is feasible, and a gain on three knots of stiffness is") {
  const TissueBox<> box = limpid::scaled_box(whole, 0.93);
  CHECK(limpid::printed_theorem5<double>(slow, box, rates).at_centre.lmi.solve().verdict == Verdict::infeasible);
  CHECK(design_spline(slow, KnotGrid<>::uniform(box, 2, 2), rates).verdict == Verdict::infeasible);
  const auto design = design_spline(slow, KnotGrid<>::uniform(box, 3, 2), rates);
  REQUIRE(design.verdict == Verdict::feasible);
  CHECK(design.gain.L.size() == 6);
  CHECK(limpid::verify_spline(slow, design.gain, rates).verdict == Verdict::feasible);
}

TEST_CASE("knots do not help at .95, and the multipliers prove it") {
  const auto design = design_spline(slow, KnotGrid<>::uniform(limpid::scaled_box(whole, 0.95), 3, 2), rates);
  CHECK(design.verdict == Verdict::infeasible);
  CHECK(!design.multipliers.Z.empty());
}

TEST_CASE("what is feasible with an affine gain is so with knots") {
  const TissueBox<> box = limpid::scaled_box(whole, 0.9);
  CHECK(limpid::printed_theorem5<double>(slow, box, rates).at_centre.lmi.solve().verdict == Verdict::feasible);
  CHECK(design_spline(slow, KnotGrid<>::uniform(box, 2, 2), rates).verdict == Verdict::feasible);
}

TEST_CASE("a spline that only an unstable loop would have is not verified") {
  limpid::GainSpline<> gain{KnotGrid<>::uniform(whole, 2, 2), {}};
  gain.L.assign(4, limpid::Gain<>(5000, 0));  // the predictor's spring overcome
  CHECK(limpid::verify_spline(slow, gain, rates).verdict == Verdict::infeasible);
}

TEST_CASE("the gain at run time is the one that was designed") {
  limpid::GainSpline<> gain{KnotGrid<>::uniform(whole, 3, 2), {}};
  for (int i = 0; i < 6; ++i) gain.L.push_back({-10.0 * i, 0.5 * i * i});
  limpid::GainTable<1> table(limpid::gain_table(gain, rates));
  for (const auto& [k, b] : {std::pair{200.0, 20.0}, {650.0, 25.0}, {1999.0, 39.0}, {1100.0, 40.0}}) {
    limpid::GainTable<1> fresh = table;
    (void)fresh.update(0.0, {Eigen::Array<double, 1, 1>::Constant(k), Eigen::Array<double, 1, 1>::Constant(b)});
    const limpid::Gain<> L = gain({k, b});
    CHECK(fresh.row().L1[0] == doctest::Approx(L[0]).epsilon(1e-13));
    CHECK(fresh.row().L2[0] == doctest::Approx(L[1]).epsilon(1e-13));
  }
}

TEST_CASE("knots that cannot be used are refused") {
  CHECK_THROWS_AS((void)KnotGrid<>::uniform(whole, 1, 2), std::invalid_argument);
  CHECK_THROWS_AS((void)KnotGrid<>::uniform({{200, 20}, {200, 40}}, 2, 2), std::invalid_argument);
  limpid::GainSpline<> gain{KnotGrid<>::uniform(whole, 2, 2), {}};
  CHECK_THROWS_AS((void)limpid::verify_spline(slow, gain, rates), std::invalid_argument);
}
