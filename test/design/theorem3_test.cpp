// SPDX-License-Identifier: MIT
#include "design/theorem_reference.hpp"
#include "design_instances.hpp"
#include "support/no_allocation.hpp"

#include <limpid/design/theorem3.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace {

using namespace limpid;
using namespace limpid::test;

const Gain<double> gain_016{-441.3, -12.12}, gain_032{-203.3, -5.15}, gain_1{-195.1, -4.89};  // Table 6.4

Verdict verdict_at(double T_d, const Gain<double>& L, double k, double b) {
  return verify_theorem3(design_at(T_d), Tissue<double>{k, b}, L).verdict;
}

/// Whether the certificate proves (4.24): negative definite on the null spaces of E' and C, in 50 digits.
bool proves_feasible(const PredictorDesign<double>& design, const Tissue<double>& tissue, const Gain<double>& L,
                     const detail::LyapunovMatrices<double>& found, double d) {
  const FiftyPoint at(design, tissue, L, d);
  const auto P = in_fifty(found.P), Q = in_fifty(found.Q), R = in_fifty(found.R);
  const FiftyMatrix<8, 8> Xi = at.without_M(P, Q, R);
  const FiftyMatrix<2, 2> I = FiftyMatrix<2, 2>::Identity(), O = FiftyMatrix<2, 2>::Zero();
  FiftyMatrix<8, 6> across_E, across_C;
  across_E << -at.a2 * I, -at.a3 * I, O, I, O, O, O, I, O, O, O, I;
  across_C << I, O, O, O, I, O, at.A, at.BL, O, O, O, I;
  return positive_definite(P) && positive_definite(Q) && positive_definite(R) &&
         positive_definite(FiftyMatrix<6, 6>(-across_E.transpose() * Xi * across_E)) &&
         positive_definite(FiftyMatrix<6, 6>(-across_C.transpose() * Xi * across_C));
}

}  // namespace

TEST_CASE("Table 6.4's gains are feasible in 399, 399 and 381 of 399 cells, the 18 as listed, and none is open") {
  const struct {
    double T_d;
    Gain<double> L;
    int feasible;
  } cases[] = {{0.016, gain_016, 399}, {0.032, gain_032, 399}, {0.1, gain_1, 381}};
  for (const auto& c : cases) {
    CAPTURE(c.T_d);
    int feasible = 0;
    for (int k = 200; k <= 2000; k += 100) {
      for (int b = 20; b <= 40; ++b) {
        const auto verdict = verdict_at(c.T_d, c.L, k, b);
        const bool listed = c.feasible == 381 && k == 200 && b >= 23;
        if (verdict != (listed ? Verdict::infeasible : Verdict::feasible)) FAIL_CHECK("k_e ", k, " b_e ", b);
        feasible += verdict == Verdict::feasible;
      }
    }
    CHECK(feasible == c.feasible);
  }
}

TEST_CASE("The border of Table 6.4's third gain is where the notes have it") {
  // k_e to a tenth at b_e = 20 and 23, to one at 30 and 40
  const struct { double b, k, digit; } border[] = {{20, 191.8, 0.1}, {23, 200.8, 0.1}, {30, 230, 1}, {40, 284, 1}};
  for (const auto& point : border) {
    CAPTURE(point.b);
    CHECK(verdict_at(0.1, gain_1, point.k + point.digit, point.b) == Verdict::feasible);
    CHECK(verdict_at(0.1, gain_1, point.k - point.digit, point.b) == Verdict::infeasible);
  }
}

TEST_CASE("Close to the border a verdict is still reached, and changes once") {
  double low = 200, high = 202;  // infeasible, feasible at b_e = 23
  while (high - low > 1e-7) {
    const double middle = (low + high) / 2;
    const Verdict verdict = verdict_at(0.1, gain_1, middle, 23);
    CAPTURE(middle);
    CHECK(verdict != Verdict::undecided);
    (verdict == Verdict::feasible ? high : low) = middle;
  }
  CHECK(low == doctest::Approx(200.8).epsilon(5e-4));
}

TEST_CASE("The certificate of a feasible case holds in 50 digits") {
  for (const auto& given : {std::pair(0.016, gain_016), std::pair(0.032, gain_032), std::pair(0.1, gain_1)}) {
    const double T_d = given.first;
    const Gain<double> L = given.second;
    for (const Tissue<double> tissue : {Tissue<double>{1100, 30}, Tissue<double>{2000, 20}, Tissue<double>{285, 40}}) {
      CAPTURE(T_d);
      CAPTURE(tissue.stiffness);
      const auto design = design_at(T_d);
      const auto result = verify_theorem3(design, tissue, L);
      REQUIRE(result.verdict == Verdict::feasible);
      CHECK(result.certificate.verdict == Verdict::feasible);
      CHECK(proves_feasible(design, tissue, L, result.certificate.lyapunov, detail::time_scale(design, tissue)));
    }
  }
}

TEST_CASE("The certificate of an infeasible case separates in 50 digits") {
  const auto design = design_at(0.1);
  for (const double b : {23.0, 30.0, 40.0}) {
    CAPTURE(b);
    const Tissue<double> tissue{200, b};
    const auto result = verify_theorem3(design, tissue, gain_1);
    REQUIRE(result.verdict == Verdict::infeasible);
    const FiftyPoint at(design, tissue, gain_1, detail::time_scale(design, tissue));
    const FiftyMatrix<2, 2> I = FiftyMatrix<2, 2>::Identity(), O = FiftyMatrix<2, 2>::Zero();
    FiftyMatrix<6, 4> across_E, across_C;
    across_E << -at.a2 * I, -at.a3 * I, I, O, O, I;
    across_C << I, O, O, I, at.A, at.BL;
    FiftyMatrix<4, 4> Z_E, Z_C;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        Z_E(i, j) = Fifty(result.certificate.multipliers.Z_multiplier(i, j));
        Z_C(i, j) = Fifty(result.certificate.multipliers.Z_dynamics[0](i, j));
      }
    }
    CHECK(positive_definite(Z_E));
    CHECK(positive_definite(Z_C));
    // <Xi0(P, Q, R), Z> = <P, Z_P> + <Q, Z_Q> + <R, Z_R> with all three > 0: never < 0 for P, Q, R > 0
    const FiftyMatrix<6, 6> Z = across_E * Z_E * across_E.transpose() + across_C * Z_C * across_C.transpose();
    const FiftyMatrix<2, 2> Z11 = Z.block<2, 2>(0, 0), Z21 = Z.block<2, 2>(2, 0), Z22 = Z.block<2, 2>(2, 2),
                            Z31 = Z.block<2, 2>(4, 0), Z33 = Z.block<2, 2>(4, 4);
    CHECK(positive_definite(FiftyMatrix<2, 2>(Z31 + Z31.transpose())));
    CHECK(positive_definite(FiftyMatrix<2, 2>(Z11 - Z22)));
    CHECK(positive_definite(FiftyMatrix<2, 2>(Z33 * at.T - (Z11 - Z21 - Z21.transpose() + Z22) / at.T)));
  }
}

TEST_CASE("A neighbour's certificate serves where it holds, and only there") {
  const auto design = design_at(0.1);
  const auto feasible = verify_theorem3(design, Tissue<double>{1100, 30}, gain_1);
  const auto near = verify_theorem3(design, Tissue<double>{1110, 30}, gain_1, &feasible.certificate);
  CHECK(near.verdict == Verdict::feasible);
  CHECK(near.iterations == 0);
  const auto far = verify_theorem3(design, Tissue<double>{200, 30}, gain_1, &feasible.certificate);
  CHECK(far.verdict == Verdict::infeasible);
  const auto beside = verify_theorem3(design, Tissue<double>{199, 30}, gain_1, &far.certificate);
  CHECK(beside.verdict == Verdict::infeasible);
  CHECK(beside.iterations == 0);
}

TEST_CASE("A neighbour's certificate that is not symmetric proves nothing") {
  const auto design = design_at(0.1);
  const auto serves = [&](const Tissue<double>& tissue, const Theorem3Certificate<double>& certificate) {
    return verify_theorem3(design, tissue, gain_1, &certificate).iterations == 0;
  };
  const auto feasible = verify_theorem3(design, Tissue<double>{1100, 30}, gain_1).certificate;
  REQUIRE(serves({1100, 30}, feasible));
  for (const auto matrix : {&detail::LyapunovMatrices<double>::P, &detail::LyapunovMatrices<double>::Q,
                            &detail::LyapunovMatrices<double>::R}) {
    auto skewed = feasible;
    (skewed.lyapunov.*matrix).a12 *= 1 + 1e-12;
    CHECK_FALSE(serves({1100, 30}, skewed));
  }
  const auto infeasible = verify_theorem3(design, Tissue<double>{200, 30}, gain_1).certificate;
  REQUIRE(serves({200, 30}, infeasible));
  for (const int row : {1, 3}) {
    auto skewed = infeasible;
    skewed.multipliers.Z_dynamics[0](row, 0) *= 1 + 1e-12;
    CHECK_FALSE(serves({200, 30}, skewed));
  }
}

TEST_CASE("Over a box one P, Q, R serves every tissue, and no single one the whole box at Table 6.4's gains") {
  const auto design = design_at(0.032);
  const TissueBox<double> small{{1000, 28}, {1200, 32}};
  const auto result = verify_theorem3(design, small, gain_032);
  REQUIRE(result.verdict == Verdict::feasible);
  const double d = detail::time_scale(design, small.centre());
  for (const double k : {1000.0, 1050.0, 1200.0}) {
    for (const double b : {28.0, 31.0, 32.0}) {
      CHECK(proves_feasible(design, {k, b}, gain_032, result.certificate.lyapunov, d));
    }
  }
  CHECK(verify_theorem3(design_at(0.016), box, gain_016).verdict == Verdict::infeasible);
  CHECK(verify_theorem3(design, box, gain_032).verdict == Verdict::infeasible);
  CHECK(verify_theorem3(design_at(0.1), box, gain_1).verdict == Verdict::infeasible);
}

TEST_CASE("A list of tissues has the verdict of the box whose vertices they are") {
  const auto design = design_at(0.016);
  for (const TissueBox<double>& box :
       {TissueBox<double>{{1000, 28}, {1200, 32}}, TissueBox<double>{{200, 20}, {2000, 40}}}) {
    const std::vector<Tissue<double>> list{
        box.lower, {box.lower.stiffness, box.upper.damping}, {box.upper.stiffness, box.lower.damping}, box.upper};
    CHECK(verify_theorem3(design, std::span<const Tissue<double>>(list), gain_016).verdict ==
          verify_theorem3(design, box, gain_016).verdict);
  }
}

TEST_CASE("Theorem 2 has the verdict of Theorem 3") {
  CHECK(verify_theorem2(design_at(1.0 / 60), Tissue<double>{2000, 45}, Gain<double>{-753.2, -17.01}).verdict ==
        Verdict::feasible);  // design case 1
}

TEST_CASE("The verdict does not depend on the scalar") {
  for (const double k : {200.0, 300.0}) {
    PredictorDesign<long double> design;
    design.tool.mass = 0.1L;
    design.tool.damping = 0.1L;
    design.tool.stiffness = 1;
    design.T_d = 0.1L;
    const auto wide = verify_theorem3(design, Tissue<long double>{k, 30}, Gain<long double>(-195.1L, -4.89L));
    CHECK(wide.verdict == verdict_at(0.1, gain_1, k, 30));
  }
}

TEST_CASE("A verdict of double allocates nothing") {
  const auto design = design_at(0.1);
  const TissueBox<double> box{{1000, 28}, {1200, 32}};
  Verdict feasible{}, infeasible{}, over_box{};
  check_no_allocation([&] {
    feasible = verify_theorem3(design, Tissue<double>{1100, 30}, gain_1).verdict;
    infeasible = verify_theorem3(design, Tissue<double>{200, 30}, gain_1).verdict;
    over_box = verify_theorem3(design, box, gain_1).verdict;
  });
  CHECK(feasible == Verdict::feasible);
  CHECK(infeasible == Verdict::infeasible);
  CHECK(over_box == Verdict::feasible);
}

TEST_CASE("Hard data do not throw, and nothing false is said of them") {
  // Without feedback the delay does not matter: e' = A e is stable, P alone proves it, however wild the units
  for (const double k : {1e-9, 1e-3, 1e6, 1e12, 1e300}) {
    for (const double b : {1e-9, 1.0, 1e9, 1e300}) {
      CAPTURE(k);
      CAPTURE(b);
      const Tissue<double> tissue{k, b};
      CHECK_NOTHROW(static_cast<void>(verify_theorem3(design_at(0.01, 0), tissue, Gain<double>(0, 0))));
    }
  }
  // An unstable tissue cannot be feasible without feedback.
  CHECK(verdict_at(0.01, {0, 0}, 1000, -5) == Verdict::infeasible);
}

TEST_CASE("Bad input is refused by name") {
  const Tissue<double> tissue{1100, 30};
  const auto refused = [&](const PredictorDesign<double>& design, const Tissue<double>& at, const Gain<double>& L) {
    CHECK_THROWS_AS(static_cast<void>(verify_theorem3(design, at, L)), std::invalid_argument);
  };
  auto design = design_at(0);
  refused(design, tissue, gain_1);
  design = design_at(0.1);
  design.tool.mass = -1;
  refused(design, tissue, gain_1);
  design = design_at(0.1);
  refused(design, {-1, 30}, gain_1);
  refused(design, {1100, std::nan("")}, gain_1);
  refused(design, tissue, {std::nan(""), 0});
  CHECK_THROWS_AS(static_cast<void>(verify_theorem3(design, std::span<const Tissue<double>>{}, gain_1)),
                  std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(verify_theorem3(design, TissueBox<double>{{300, 30}, {200, 30}}, gain_1)),
                  std::invalid_argument);
}
