// SPDX-License-Identifier: MIT
#include "design/theorem_reference.hpp"
#include "design_instances.hpp"
#include "support/no_allocation.hpp"

#include <limpid/design/theorem3_design.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

namespace {

using namespace limpid;
using namespace limpid::test;

/// (4.24) of the bars, with X = M1^-1 undone by no more than a congruence: Xi0 + He(E [-A X'  -B L X'  X']) < 0.
bool proves_feasible(const PredictorDesign<double>& design, const Tissue<double>& tissue, const Gain<double>& L,
                     const detail::GainVariables<double, 1>& found, double d) {
  const FiftyPoint at(design, tissue, L, d);
  const auto P = in_fifty(found.P[0]), Q = in_fifty(found.Q), R = in_fifty(found.R), X = in_fifty(found.X);
  return positive_definite(P) && positive_definite(Q) && positive_definite(R) &&
         positive_definite(FiftyMatrix<8, 8>(-at.with_gain(P, Q, R, X)));
}

}  // namespace

TEST_CASE("The gain that is found has its proof in 50 digits, rounded as it is") {
  for (const double T_d : {0.016, 0.032, 0.1}) {
    for (const Tissue<double> tissue : {Tissue<double>{1100, 30}, Tissue<double>{200, 20}, Tissue<double>{2000, 40}}) {
      CAPTURE(T_d);
      CAPTURE(tissue.stiffness);
      const auto design = design_at(T_d);
      const auto result = design_theorem3(design, tissue);
      REQUIRE(result.verdict == Verdict::feasible);
      CHECK(proves_feasible(design, tissue, result.gain, result.certificate.variables,
                            detail::time_scale(design, tissue)));
      CHECK(verify_theorem3(design, tissue, result.gain).verdict == Verdict::feasible);
    }
  }
}

TEST_CASE("A soft and strongly damped tissue with a long delay has no gain, which its slow mode proves") {
  for (int b = 20; b <= 40; ++b) {
    CAPTURE(b);
    const auto result = design_theorem3(design_at(0.1), Tissue<double>{200, double(b)});
    CHECK(result.verdict == (b >= 32 ? Verdict::infeasible : Verdict::feasible));
  }
}

TEST_CASE("One gain for a whole box is proved at tissues inside") {
  const auto design = design_at(0.016);
  const auto result = design_theorem3(design, box);
  REQUIRE(result.verdict == Verdict::feasible);
  for (const double k : {200.0, 777.0, 2000.0}) {
    for (const double b : {20.0, 33.0, 40.0}) {
      CHECK(proves_feasible(design, {k, b}, result.gain, result.certificate.variables,
                            detail::time_scale(design, box.centre())));
    }
  }
  CHECK(verify_theorem3(design, box, result.gain).verdict == Verdict::feasible);
}

TEST_CASE("What the verdict for a box with a common gain is, it is for the list of its vertices") {
  const auto design = design_at(0.1);
  const auto corners = detail::vertices(box);
  CHECK(design_theorem3(design, box).verdict == Verdict::infeasible);
  CHECK(design_theorem3(design, std::span<const Tissue<double>>(corners)).verdict == Verdict::infeasible);
}

TEST_CASE("A neighbour's gain is taken where its certificate holds") {
  const auto design = design_at(0.032);
  const auto first = design_theorem3(design, Tissue<double>{1100, 30});
  const auto second = design_theorem3(design, Tissue<double>{1105, 30}, &first.certificate);
  CHECK(second.verdict == Verdict::feasible);
  CHECK(second.iterations == 0);
  CHECK(second.gain == first.gain);
  const auto third = design_theorem3(design_at(0.1), Tissue<double>{200, 40}, &first.certificate);
  CHECK(third.verdict == Verdict::infeasible);
}

TEST_CASE("Theorem 2's design is Theorem 3's") {
  const auto design = design_at(1.0 / 60);
  const Tissue<double> tissue{2000, 45};
  CHECK(design_theorem2(design, tissue).gain == design_theorem3(design, tissue).gain);
}

TEST_CASE("A design in double allocates nothing, and is the same each time") {
  const auto design = design_at(0.1);
  GainDesign<double, 1> first, second;
  check_no_allocation([&] {
    first = design_theorem3(design, Tissue<double>{1100, 30});
    second = design_theorem3(design, Tissue<double>{1100, 30});
  });
  CHECK(first.verdict == Verdict::feasible);
  CHECK(first.gain == second.gain);
}

TEST_CASE("Bad input to a design is refused") {
  CHECK_THROWS_AS(static_cast<void>(design_theorem3(design_at(-1), Tissue<double>{1100, 30})), std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(design_theorem3(design_at(0.1), std::span<const Tissue<double>>{})),
                  std::invalid_argument);
}
