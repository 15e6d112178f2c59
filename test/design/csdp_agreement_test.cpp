// SPDX-License-Identifier: MIT
#include "design_instances.hpp"

#include <limpid/design/printed_theorems.hpp>
#include <limpid/design/theorem3.hpp>

#include <doctest/doctest.h>

#include <support/csdp.hpp>

#include <cmath>
#include <optional>
#include <random>
#include <span>

using limpid::Gain;
using limpid::PredictorDesign;
using limpid::Tissue;
using limpid::Verdict;
using limpid::verify_theorem3;

namespace {

struct Problem {
  PredictorDesign<> design;
  Tissue<> tissue;
  Gain<> L;
};

// Any gain whose parts are of the size of the tissue's; every other time one close to where feasibility ends.
Problem draw(std::mt19937& random, bool near_boundary) {
  std::uniform_real_distribution<double> uniform(0, 1), both(-1, 1);
  Problem p;
  p.design = {.tool = {.mass = 0.1, .damping = 0.1, .stiffness = std::floor(2 * uniform(random))},
              .T_d = 0.01 * std::pow(10.0, uniform(random))};
  p.tissue = {200 + 1800 * uniform(random), 20 + 20 * uniform(random)};
  const Gain<> direction(1.5 * p.tissue.stiffness * both(random), 2 * p.tissue.damping * both(random));
  p.L = direction * uniform(random);
  if (!near_boundary) return p;
  const auto feasible = [&](double scale) {
    return verify_theorem3(p.design, p.tissue, Gain<>(direction * scale)).verdict == Verdict::feasible;
  };
  double inside = 0, outside = 4;
  if (!feasible(inside) || feasible(outside)) return p;
  for (int i = 0; i < 30; ++i) (feasible((inside + outside) / 2) ? inside : outside) = (inside + outside) / 2;
  const double off = std::pow(10.0, -2 - 4 * uniform(random));  // 1e-2 to 1e-6 of the gain
  p.L = direction * inside * (both(random) < 0 ? 1 - off : 1 + off);
  return p;
}

}  // namespace

// CSDP's margin t, of tr F = n, is good to some 1e-7: below 1e-6 its sign says nothing, and the certificate decides.
// Only where the margin is 0 to less than CSDP sees may a verdict be left open.
TEST_CASE("verdicts agree with CSDP on 2000 random problems, half of them near the boundary") {
  if (!limpid::test::has_csdp()) {
    MESSAGE("csdp is not installed: skipped");
    return;
  }
  constexpr unsigned seed = 3;
  CAPTURE(seed);
  std::mt19937 random(seed);
  const limpid::test::Csdp csdp;
  int feasible = 0, close = 0, failed = 0, open = 0, outranked = 0;
  for (int i = 0; i < 2000; ++i) {
    CAPTURE(i);
    const Problem p = draw(random, i % 2 == 1);
    const Verdict reduced = verify_theorem3(p.design, p.tissue, p.L).verdict;
    const auto printed = limpid::printed_theorem3<double>(p.design, std::span<const Tissue<>>(&p.tissue, 1), p.L);
    const Verdict general = printed.lmi.solve().verdict;
    const std::optional<double> t = csdp.margin(printed.lmi.problem());
    if (!t) ++failed;
    if (reduced == Verdict::undecided || general == Verdict::undecided) {
      ++open;
      CHECK(std::abs(t.value_or(1)) < 1e-7);
    } else {
      CHECK(general == reduced);
    }
    if (reduced == Verdict::feasible) ++feasible;
    if (!t || reduced == Verdict::undecided) continue;
    if (std::abs(*t) < 1e-4) ++close;
    if (std::abs(*t) > 1e-6) {
      CHECK((*t > 0) == (reduced == Verdict::feasible));
    } else if ((*t > 0) != (reduced == Verdict::feasible)) {
      ++outranked;
    }
  }
  CHECK(feasible > 400);
  CHECK(feasible < 1600);
  CHECK(close > 200);
  CHECK(failed < 20);
  CHECK(open < 20);
  MESSAGE("feasible ", feasible, ", near the boundary ", close, ", CSDP failed ", failed, ", left open ", open,
          ", CSDP outranked ", outranked);
}
