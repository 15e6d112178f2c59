// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/ball.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/mean_value_form.hpp>
#include <limpid/design/sampled_polynomial.hpp>
#include <limpid/design/second_order_enclosure.hpp>

#include <Eigen/Core>

#include <cmath>
#include <string_view>
#include <vector>

namespace limpid {

/// What came of a proof over a box of tissues.
template <Real Scalar = double>
struct SampledProof {
  Verdict verdict = Verdict::undecided;  ///< feasible: the radius is below the bound for every tissue of the box;
                                         ///< infeasible: it is above the bound in `tissue`
  int cells{0};                          ///< looked at
  TissueBox<Scalar> cell{};              ///< where it ended, unless feasible
  Tissue<Scalar> tissue{};               ///< centre of that cell or one of its corners
  std::string_view reason{};

  [[nodiscard]] bool proved() const { return verdict == Verdict::feasible; }
};

namespace detail {

/// Characteristic polynomials of all tissues of a cell, from exact data.
template <Real Scalar>
class SampledEnclosure {
 public:
  using Number = Ball<Scalar>;
  using Form = MeanValueForm<Scalar>;

  SampledEnclosure(const SampledSystem<Scalar>& system, const Gain<Scalar>& L)
      : system_{system},
        L_{L},
        periods_{system.periods()},
        fraction_{system.fraction()},
        per_mass_{Number{Scalar{1}} / Number{system.tool.mass}} {
    L_over_m_ << Number{L[0]} / Number{system.tool.mass}, Number{L[1]} / Number{system.tool.mass};
  }

  [[nodiscard]] SampledCoefficients<Form> polynomial(const TissueBox<Scalar>& cell) const {
    const auto [kappa, beta] = parameters(cell);
    const auto flow = enclose_second_order_flow(kappa, beta, Number{system_.period});
    if (!(fraction_ > Scalar{0})) {
      return sampled_coefficients<Scalar, Form>(flow, nullptr, periods_, kappa, L_over_m_);
    }
    const auto rest = enclose_second_order_flow(kappa, beta, Number{system_.period} - Number{fraction_});
    return sampled_coefficients<Scalar, Form>(flow, &rest, periods_, kappa, L_over_m_);
  }

  [[nodiscard]] Eigen::Matrix<Form, Eigen::Dynamic, Eigen::Dynamic> monodromy(const TissueBox<Scalar>& cell) const {
    const auto [kappa, beta] = parameters(cell);
    const auto flow = enclose_second_order_flow(kappa, beta, Number{system_.period});
    const auto rest = fraction_ > Scalar{0}
                          ? enclose_second_order_flow(kappa, beta, Number{system_.period} - Number{fraction_})
                          : flow;
    return sampled_monodromy<Scalar, Form>(flow, rest, system_, kappa, Form{per_mass_}, L_);
  }

 private:
  struct Parameters {
    Form kappa, beta;
  };
  [[nodiscard]] Parameters parameters(const TissueBox<Scalar>& cell) const {
    const Form k_e = Form::first(cell.lower.stiffness, cell.upper.stiffness);
    const Form b_e = Form::second(cell.lower.damping, cell.upper.damping);
    return {per_mass_ * (Form{system_.tool.stiffness} + k_e), per_mass_ * (Form{system_.tool.damping} + b_e)};
  }

  SampledSystem<Scalar> system_;
  Gain<Scalar> L_;
  int periods_;
  Scalar fraction_;
  Number per_mass_;
  Eigen::Matrix<Number, 1, 2> L_over_m_;
};

/// Hands the conditions under which all roots of the monic p are inside the unit circle to `holds`, one by one, while
/// it says yes: each is positive, and where one is negative and all before it positive a root is outside.
template <Real Scalar, typename Holds>
[[nodiscard]] bool jury_conditions(SampledCoefficients<MeanValueForm<Scalar>> p, Holds&& holds) {
  using Form = MeanValueForm<Scalar>;
  const Form one{Scalar{1}};
  Eigen::Index N = p.size() - 1;
  // (p(z) - p_0 p*(z))/z, with p* the reversed polynomial, has one root fewer inside where |p_0| < 1.
  for (; N > 3; --N) {
    const Form k = p[0];
    if (!holds(one - k) || !holds(one + k)) return false;
    const Form scale = one / ((one - k) * (one + k));
    const auto old = p;
    for (Eigen::Index i = 0; i + 1 < N; ++i) p[i] = (old[i + 1] - k * old[N - 1 - i]) * scale;
    p[N - 1] = one;
  }
  if (N == 2) return holds(one - p[0]) && holds(one + p[1] + p[0]) && holds(one - p[1] + p[0]);
  const Form even = one + p[1], odd = p[2] + p[0];
  return holds(one - p[0]) && holds(one + p[0]) && holds(even + odd) && holds(even - odd) &&
         holds(one - p[1] + p[0] * (p[2] - p[0]));
}

/// Two halves that share their edge; false where there is no number between the ends of either side.
template <Real Scalar>
[[nodiscard]] bool halve(const TissueBox<Scalar>& cell, bool stiffness_first, TissueBox<Scalar>& low,
                         TissueBox<Scalar>& high) {
  const Tissue<Scalar> middle = cell.centre();
  const bool can_k = cell.lower.stiffness < middle.stiffness && middle.stiffness < cell.upper.stiffness;
  const bool can_b = cell.lower.damping < middle.damping && middle.damping < cell.upper.damping;
  if (!can_k && !can_b) return false;
  low = high = cell;
  if (can_k && (stiffness_first || !can_b)) {
    low.upper.stiffness = high.lower.stiffness = middle.stiffness;
  } else {
    low.upper.damping = high.lower.damping = middle.damping;
  }
  return true;
}

enum class CellOutcome { holds, fails, divide_stiffness, divide_damping };

/// One cell: whether all roots over it are smaller than a radius, and where not.
template <Real Scalar>
struct CellTest {
  using Number = Ball<Scalar>;
  using Form = MeanValueForm<Scalar>;

  TissueBox<Scalar> cell;
  CellOutcome outcome = CellOutcome::holds;
  Tissue<Scalar> tissue{};  // where it fails

  CellTest(const SampledEnclosure<Scalar>& enclosure, const TissueBox<Scalar>& over, const Scalar& radius)
      : cell{over}, tissue{over.centre()} {
    auto p = enclosure.polynomial(cell);
    const Number inverse = Number{Scalar{1}} / Number{radius};
    Number power = inverse;
    for (Eigen::Index i = p.size() - 2; i >= 0; --i, power *= inverse) p[i] = power * p[i];
    bool at_centre = true;  // all conditions so far hold there
    (void)jury_conditions<Scalar>(p, [&](const Form& condition) {
      if (outcome == CellOutcome::holds && !condition.range().certainly_positive()) fail(condition);
      if (condition.centre().certainly_negative() && at_centre) {
        outcome = CellOutcome::fails;
        tissue = cell.centre();
      }
      at_centre = at_centre && condition.centre().certainly_positive();
      return at_centre && outcome != CellOutcome::fails;
    });
  }

 private:
  // The first condition that does not hold all over the cell: those before hold at its lowest corner too.
  void fail(const Form& condition) {
    const bool low_stiffness = condition.slope1().centre() > Scalar{0};
    const bool low_damping = condition.slope2().centre() > Scalar{0};
    const Tissue<Scalar> corner{low_stiffness ? cell.lower.stiffness : cell.upper.stiffness,
                                low_damping ? cell.lower.damping : cell.upper.damping};
    const Number at_corner = condition.at(place(cell.lower.stiffness, cell.upper.stiffness, corner.stiffness),
                                          place(cell.lower.damping, cell.upper.damping, corner.damping));
    if (at_corner.certainly_negative()) {
      outcome = CellOutcome::fails;
      tissue = corner;
    } else {
      const bool stiffness = condition.range().bounded()
                                 ? condition.slope1().magnitude() > condition.slope2().magnitude()
                                 : relative_width(cell.lower.stiffness, cell.upper.stiffness) >
                                       relative_width(cell.lower.damping, cell.upper.damping);
      outcome = stiffness ? CellOutcome::divide_stiffness : CellOutcome::divide_damping;
    }
  }

  static Scalar relative_width(const Scalar& lower, const Scalar& upper) {
    using std::abs;
    return upper > lower ? (upper - lower) / (abs(lower) + abs(upper)) : Scalar{0};
  }

  // Delta of a value of the side [lower, upper].
  static Number place(const Scalar& lower, const Scalar& upper, const Scalar& value) {
    const Number side = Number::between(lower, upper);
    if (side.radius() == Scalar{0}) return Number{};
    return (Number{value} - Number{side.centre()}) / Number{side.radius()};
  }
};

}  // namespace detail

/// Proves that the spectral radius of the sampled error is below `radius` for every constant tissue of the box, or that
/// it is above it for one: by halving the box until the conditions of Jury, enclosed with everything that is rounded,
/// hold all over each cell. The given numbers are taken as exact.
///
/// Off line: some 2 us a cell; cells gather where the radius comes close to the bound.
/// @param most_cells  looked at before it gives up
/// @throws std::invalid_argument  where an argument is not finite, the box is empty, the system refused or the radius
///                                not positive
template <Real Scalar>
[[nodiscard]] SampledProof<Scalar> prove_sampled_stability(const SampledSystem<Scalar>& system,
                                                           const TissueBox<Scalar>& box, const Gain<Scalar>& L,
                                                           const Scalar& radius = Scalar{1}, int most_cells = 100'000) {
  system.check();
  box.check();
  expect(is_finite(L), "prove_sampled_stability: gain", "finite", L);
  expect(is_finite(radius) && radius > Scalar{0}, "prove_sampled_stability: radius", "finite and > 0", radius);
  expect(most_cells > 0, "prove_sampled_stability: most_cells", "> 0", most_cells);
  const detail::SampledEnclosure<Scalar> enclosure(system, L);
  std::vector<TissueBox<Scalar>> open{box};
  SampledProof<Scalar> proof;
  while (!open.empty()) {
    proof.cell = open.back();
    if (proof.cells == most_cells) {
      proof.reason = "cells exhausted: the radius comes too close to the bound";
      return proof;
    }
    open.pop_back();
    ++proof.cells;
    const detail::CellTest<Scalar> test(enclosure, proof.cell, radius);
    if (test.outcome == detail::CellOutcome::holds) continue;
    proof.tissue = test.tissue;
    if (test.outcome == detail::CellOutcome::fails) {
      proof.verdict = Verdict::infeasible;
      proof.reason = "a tissue has a radius above the bound";
      return proof;
    }
    TissueBox<Scalar> low, high;
    if (!detail::halve(proof.cell, test.outcome == detail::CellOutcome::divide_stiffness, low, high)) {
      proof.reason = "a cell cannot be halved: the radius is at the bound, or the numbers too large";
      return proof;
    }
    open.push_back(high);
    open.push_back(low);
  }
  proof.verdict = Verdict::feasible;
  proof.reason = "the radius is below the bound in every cell";
  return proof;
}

/// The same for one tissue.
template <Real Scalar>
[[nodiscard]] SampledProof<Scalar> prove_sampled_stability(const SampledSystem<Scalar>& system,
                                                           const Tissue<Scalar>& tissue, const Gain<Scalar>& L,
                                                           const Scalar& radius = Scalar{1}) {
  return prove_sampled_stability(system, TissueBox<Scalar>{tissue, tissue}, L, radius, 1);
}

}  // namespace limpid
