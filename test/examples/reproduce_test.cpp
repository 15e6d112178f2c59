// SPDX-License-Identifier: MIT
#include "common/section.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace limpid::examples;

namespace {

double figure(const SectionReport& report, const std::string& name) {
  for (const Comparison& comparison : report.figures) {
    if (comparison.name == name) return comparison.ours;
  }
  FAIL("no figure " << name);
  return 0;
}

}  // namespace

TEST_CASE("Table 6.5 comes out within 3.5 points of print in every case, with one setting for all") {
  const SectionReport report = section_6_1_4({});
  REQUIRE(report.cases.size() == 9);
  double bound_miss = 0, l2_miss = 0;
  for (const CaseComparison& which : report.cases) {
    CAPTURE(which.number);
    const double bound = std::abs(which.bound_change - which.printed_bound_change);
    const double l2 = std::abs(which.l2_change - which.printed_l2_change);
    CHECK(bound <= 0.035);
    CHECK(l2 <= 0.035);
    bound_miss += bound / 9;
    l2_miss += l2 / 9;
  }
  CHECK(bound_miss < 0.0175);
  CHECK(l2_miss < 0.02);
}

// Figures of an independent computation, to the digits it states.
TEST_CASE("6.1.1: feedback helps where the first error stood before the start, and not where it did not") {
  const SectionReport report = section_6_1_1();
  CHECK(figure(report, "mean position error over no feedback, initial error as history") ==
        doctest::Approx(0.80).epsilon(0.01));
  CHECK(figure(report, "mean position error over no feedback, zero history") == doctest::Approx(1.00).epsilon(0.01));
}

TEST_CASE("6.1.2: hold's error settles at 4.9e-4 and the predictor's vanishes") {
  const SectionReport report = section_6_1_2();
  CHECK(figure(report, "hold's error, settled amplitude") == doctest::Approx(4.9e-4).epsilon(0.02));
  CHECK(figure(report, "predictor's error after 1 s") < 1e-12);  // rounding of states of 1e-2
}

TEST_CASE("6.1.3: the estimates settle and the errors peak as computed independently") {
  const SectionReport report = section_6_1_3();
  const double digits = 0.01;  // three stated digits, and a tick of 0.1 ms
  CHECK(figure(report, "worst case: k within 5 % after") == doctest::Approx(0.156).epsilon(digits));
  CHECK(figure(report, "worst case: b within 5 % after") == doctest::Approx(0.87).epsilon(digits));
  CHECK(figure(report, "worst case: largest error over hold's") == doctest::Approx(2.08).epsilon(digits));
  CHECK(figure(report, "typical case: k within 5 % after") == doctest::Approx(0.148).epsilon(digits));
  CHECK(figure(report, "typical case: b within 5 % after") == doctest::Approx(0.171).epsilon(digits));
  CHECK(figure(report, "typical case: largest error over hold's") == doctest::Approx(0.255).epsilon(digits));
}

TEST_CASE("6.1.2: the bound (4.32) of case 2 is that of an independent solver, and its tighter form too") {
  const SectionReport report = section_6_1_2();
  CHECK(figure(report, "Fig. 6.7: bound (4.32) of |e| over |Delta_T|, as printed") ==
        doctest::Approx(5742).epsilon(0.001));
  CHECK(figure(report, "Fig. 6.7: the same with gamma B for gamma I") == doctest::Approx(37.8).epsilon(0.002));
}

TEST_CASE("6.2.2: an affine gain of our own has the whole box at 16 and 32 ms, and 0.928 of it at 100 ms") {
  const SectionReport report = section_6_2_2();
  const std::string own = ": a gain of our own, largest box with it";
  CHECK(figure(report, "Fig. 6.35, T_d = 0.016 s" + own) == 1);
  CHECK(figure(report, "Fig. 6.37, T_d = 0.032 s" + own) == 1);
  CHECK(figure(report, "Fig. 6.39, T_d = 0.1 s" + own) == doctest::Approx(0.928).epsilon(0.01));
}

TEST_CASE("what one set of variables certifies, a set for each cell does too") {
  const PressForce press = raised_cosine_force(10, 0.5, std::chrono::seconds{2});
  for (const SectionReport& report : {section_6_2_1(), section_7_1(press)}) {
    CAPTURE(report.title);
    REQUIRE_FALSE(report.heat_maps.empty());
    for (const auto& plot : report.heat_maps) {
      const auto& panels = plot.second.panels;
      if (panels.size() != 3) continue;  // a scheduled gain's
      CAPTURE(plot.first);
      for (std::size_t i = 0; i < panels[0].values.size(); ++i) REQUIRE(panels[1].values[i] <= panels[0].values[i]);
    }
  }
}

TEST_CASE("6.1.1: most a2 and a3 allow a gain, and that of largest margin is nowhere as good as the printed one") {
  const SectionReport report = section_6_1_1();
  CHECK(figure(report, "Fig. 6.1: feasible") > 200);
  CHECK(figure(report, "Fig. 6.1: smallest mean error over no feedback") > 0.80);  // the printed gain's, below
  CHECK(figure(report, "Fig. 6.1: the printed gain, on the same simulation") == doctest::Approx(0.80).epsilon(0.01));
}
