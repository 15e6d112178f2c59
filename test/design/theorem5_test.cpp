// SPDX-License-Identifier: MIT
#include "design/theorem_reference.hpp"
#include "design_instances.hpp"
#include "support/no_allocation.hpp"

#include <limpid/design/theorem5.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

namespace {

using namespace limpid;
using namespace limpid::test;

/// Half widths about (1100, 30) scaled.
TissueBox<double> box_of(double size) {
  return {{1100 - 900 * size, 30 - 10 * size}, {1100 + 900 * size, 30 + 10 * size}};
}

/// (4.51) in 50 digits at one tissue and one rate, from P(rho) = P_0 + xi_1 P_1 + xi_2 P_2.
bool holds_at(const PredictorDesign<double>& design, const TissueBox<double>& box, const AffineGain<double>& gain,
              const detail::GainVariables<double, 3>& found, const Tissue<double>& rho, const Tissue<double>& rate) {
  const double d = detail::time_scale(design, box.centre());
  FiftyPoint at(design, rho, {0, 0}, d);
  const Fifty m(design.tool.mass);
  const auto L = [&](int j) {
    return Fifty(gain.L0[j]) + Fifty(gain.L1[j]) * Fifty(rho.stiffness) + Fifty(gain.L2[j]) * Fifty(rho.damping);
  };
  at.BL(1, 0) = L(0) / (m * d * d);
  at.BL(1, 1) = L(1) / (m * d);
  const auto xi = [](double value, double lower, double upper) {
    return (2 * Fifty(value) - Fifty(lower) - Fifty(upper)) / (Fifty(upper) - Fifty(lower));
  };
  const auto slope = [d](double by, double lower, double upper) {
    return 2 * Fifty(by) / ((Fifty(upper) - Fifty(lower)) * d);
  };
  const auto P0 = in_fifty(found.P[0]), P1 = in_fifty(found.P[1]), P2 = in_fifty(found.P[2]), Q = in_fifty(found.Q),
             R = in_fifty(found.R), X = in_fifty(found.X);
  const FiftyMatrix<2, 2> P = P0 + P1 * xi(rho.stiffness, box.lower.stiffness, box.upper.stiffness) +
                              P2 * xi(rho.damping, box.lower.damping, box.upper.damping);
  FiftyMatrix<8, 8> Xi = at.with_gain(P, Q, R, X);
  Xi.topLeftCorner<2, 2>() += P1 * slope(rate.stiffness, box.lower.stiffness, box.upper.stiffness) +
                              P2 * slope(rate.damping, box.lower.damping, box.upper.damping);
  return positive_definite(P) && positive_definite(Q) && positive_definite(R) &&
         positive_definite(FiftyMatrix<8, 8>(-Xi));
}

}  // namespace

TEST_CASE("The whole box of 6.2.1 has a scheduled gain at T_d = .016 and .032, and none at .1") {
  CHECK(design_theorem5(design_at(0.016, 0), box_of(1), rates).verdict == Verdict::feasible);
  CHECK(design_theorem5(design_at(0.032, 0), box_of(1), rates).verdict == Verdict::feasible);
  const auto none = design_theorem5(design_at(0.1, 0), box_of(1), rates);
  CHECK(none.verdict == Verdict::infeasible);
  CHECK(none.certificate.verdict == Verdict::infeasible);
}

TEST_CASE("At T_d = .1 the largest box is that of .928, to one per cent") {
  const auto design = design_at(0.1, 0);
  CHECK(design_theorem5(design, box_of(0.92), rates).verdict == Verdict::feasible);
  CHECK(design_theorem5(design, box_of(0.935), rates).verdict == Verdict::infeasible);
}

TEST_CASE("The scheduled gain has its proof in 50 digits all over the box and at all rates") {
  for (const double T_d : {0.016, 0.032}) {
    CAPTURE(T_d);
    const auto design = design_at(T_d, 0);
    const auto box = box_of(1);
    const auto result = design_theorem5(design, box, rates);
    REQUIRE(result.verdict == Verdict::feasible);
    for (const double k : {200.0, 901.0, 2000.0}) {
      for (const double b : {20.0, 27.0, 40.0}) {
        for (const double sign : {-1.0, 0.3, 1.0}) {
          CHECK(holds_at(design, box, result.gain, result.certificate.variables, {k, b},
                         {sign * rates.stiffness, -sign * rates.damping}));
          CHECK(holds_at(design, box, result.gain, result.certificate.variables, {k, b},
                         {sign * rates.stiffness, sign * rates.damping}));
        }
      }
    }
  }
}

TEST_CASE("A gain that was found is verified, and one that destabilises is refuted") {
  const auto design = design_at(0.032, 0);
  const auto found = design_theorem5(design, box_of(1), rates);
  REQUIRE(found.verdict == Verdict::feasible);
  const auto verified = verify_theorem5(design, box_of(1), rates, found.gain);
  CHECK(verified.verdict == Verdict::feasible);
  CHECK(verified.gain.L1 == found.gain.L1);
  AffineGain<double> positive;  // positive feedback beyond the stiffness: e' = (A + B L) e is unstable even undelayed
  positive.L0 = {5000, 0};
  CHECK(verify_theorem5(design, box_of(1), rates, positive).verdict == Verdict::infeasible);
}

TEST_CASE("The multipliers of an infeasible box annihilate X, Y and leave P, Q, R positive") {
  const auto design = design_at(0.1, 0);
  const auto box = box_of(1);
  const auto result = design_theorem5(design, box, rates);
  REQUIRE(result.verdict == Verdict::infeasible);
  const auto& Z = result.certificate.multipliers.Z;
  const double d = detail::time_scale(design, box.centre());
  const auto corners = detail::vertices(box);
  FiftyMatrix<6, 6> total = FiftyMatrix<6, 6>::Zero();
  FiftyMatrix<2, 2> of_X = FiftyMatrix<2, 2>::Zero();
  FiftyMatrix<1, 2> of_Y0 = FiftyMatrix<1, 2>::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const FiftyPoint at(design, corners[k], {0, 0}, d);
    FiftyMatrix<6, 6> here = FiftyMatrix<6, 6>::Zero();
    for (std::size_t sign = 0; sign < 4; ++sign) {
      FiftyMatrix<6, 6> full;
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) full(i, j) = Fifty(Z[k][sign](i, j));
      }
      CHECK(positive_definite(full));
      here += full;
    }
    total += here;
    const FiftyMatrix<6, 2> ZE = here * at.E();
    of_X += ZE.bottomRows<2>().transpose() - at.A.transpose() * ZE.topRows<2>().transpose();
    of_Y0 += ZE.middleRows<2>(2).transpose().row(1);
  }
  const Fifty rounding = total.trace() * Fifty(1e-12);  // of doubles, which the proof takes into account
  for (const auto& entry : of_X.reshaped()) CHECK(abs(entry) < rounding);
  for (const auto& entry : of_Y0.reshaped()) CHECK(abs(entry) < rounding);
  CHECK(positive_definite(FiftyMatrix<2, 2>(total.block<2, 2>(0, 0) - total.block<2, 2>(2, 2))));
  CHECK(positive_definite(FiftyMatrix<2, 2>(total.block<2, 2>(4, 0) + total.block<2, 2>(0, 4))));
}

TEST_CASE("A box of no width is one tissue: Theorem 3's verdict, whatever the rates") {
  const TissueBox<double> point{{1100, 30}, {1100, 30}}, soft{{200, 40}, {200, 40}};
  CHECK(design_theorem5(design_at(0.1), point, rates).verdict == Verdict::feasible);
  CHECK(design_theorem5(design_at(0.1), soft, rates).verdict != Verdict::feasible);  // margin 0: the slow mode's
  const TissueBox<double> line{{1100, 25}, {1100, 35}};
  CHECK(design_theorem5(design_at(0.032), line, rates).verdict == Verdict::feasible);
}

TEST_CASE("The printed design solves one point, and its gain passes through Theorem 3's there") {
  const auto design = design_at(0.032, 0);
  const Tissue<double> rho_0{1100, 30};
  const auto printed = design_theorem5_at_point(design, rho_0);
  REQUIRE(printed.verdict == Verdict::feasible);
  const Gain<double> at_point = printed.gain(rho_0), constant = design_theorem3(design, rho_0).gain;
  CHECK(at_point.isApprox(constant, 1e-14));
  CHECK(printed.gain.L0.isApprox(constant / 3, 1e-14));
  CHECK((printed.gain.L1 * 1100.0).eval().isApprox(constant / 3, 1e-14));
  CHECK(verify_theorem5(design, {{1099, 29.9}, {1101, 30.1}}, {0, 0}, printed.gain).verdict == Verdict::feasible);
}

TEST_CASE("A scheduled design in double allocates nothing") {
  const auto design = design_at(0.016, 0);
  const auto box = box_of(1);
  ScheduledGainDesign<double> result;
  check_no_allocation([&] { result = design_theorem5(design, box, rates); });
  CHECK(result.verdict == Verdict::feasible);
}

TEST_CASE("Bad boxes, rates and gains are refused") {
  const auto design = design_at(0.1, 0);
  CHECK_THROWS_AS(static_cast<void>(design_theorem5(design, TissueBox<double>{{2, 1}, {1, 2}}, rates)),
                  std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(design_theorem5(design, TissueBox<double>{{0, 1}, {1, 2}}, rates)),
                  std::invalid_argument);  // no stiffness at a vertex
  CHECK_THROWS_AS(static_cast<void>(design_theorem5(design, box_of(1), TissueRates<double>{-1, 0})),
                  std::invalid_argument);
  AffineGain<double> bad;
  bad.L2[1] = std::nan("");
  CHECK_THROWS_AS(static_cast<void>(verify_theorem5(design, box_of(1), rates, bad)), std::invalid_argument);
}
