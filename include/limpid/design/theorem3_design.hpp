// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/gain_lmi.hpp>
#include <limpid/design/theorem3.hpp>

#include <span>
#include <string_view>

namespace limpid {

/// What proves a verdict of `design_theorem3`, in the coordinates of scaled_point.hpp; for a wider scalar's proof
/// rounded.
template <Real Scalar = double, int tissues = 1>
struct GainCertificate {
  Verdict verdict = Verdict::undecided;                       ///< what it proves
  detail::GainVariables<Scalar, 1> variables{};               ///< feasible: P, Q, R, X of the bars
  Gain<Scalar> gain = Gain<Scalar>::Zero();                   ///< feasible: for this L, N/m, N s/m
  detail::GainMultipliers<Scalar, tissues, 1> multipliers{};  ///< infeasible: Z > 0
};

template <Real Scalar = double, int tissues = 1>
struct GainDesign {
  Verdict verdict = Verdict::undecided;
  Gain<Scalar> gain = Gain<Scalar>::Zero();  ///< where feasible: N/m, N s/m; proved as it is here, rounded
  GainCertificate<Scalar, tissues> certificate{};
  int iterations = 0;         ///< of the solver; 0 where a neighbour's certificate served
  std::string_view reason{};  ///< how it was found, or why it was not

  [[nodiscard]] bool certified() const { return verdict != Verdict::undecided; }
};

namespace detail {

template <Real Scalar, int tissues, Real Given>
void decide_gain(const GainCase<Given, tissues>& given, GainDesign<Given, tissues>& result) {
  constexpr int points = points_solved<Scalar, tissues>;
  GainLmi<Scalar, points, 1, false> lmi(given.template widened<Scalar, points>());
  GainVariables<Scalar, 1> variables;
  GainMultipliers<Scalar, points, 1> multipliers;
  AffineGain<Given> gain;
  const SdpStatus status = lmi.solve(variables, gain, multipliers, result.iterations);
  result.reason = describe(status);
  auto& certificate = result.certificate;
  if (status == SdpStatus::primal_certificate) {
    result.verdict = Verdict::feasible;
    result.gain = certificate.gain = gain.L0;
    certificate.variables = {{convert<Given>(variables.P[0])},
                             convert<Given>(variables.Q),
                             convert<Given>(variables.R),
                             convert<Given>(variables.X)};
  } else if (status == SdpStatus::dual_certificate && lmi.by_mode()) {
    result.verdict = Verdict::infeasible;
    result.reason = "a real mode of one tissue has no solution";
    return;  // nothing that could serve a neighbour
  } else if (status == SdpStatus::dual_certificate) {
    result.verdict = Verdict::infeasible;
    resize(certificate.multipliers.Z, multipliers.Z.size());
    for (std::size_t k = 0; k < multipliers.Z.size(); ++k) {
      certificate.multipliers.Z[k][0] = convert<Given>(multipliers.Z[k][0]);
    }
  } else if constexpr (!std::is_void_v<Wider<Scalar>>) {
    decide_gain<Wider<Scalar>>(given, result);
    return;
  }
  certificate.verdict = result.verdict;
}

template <int tissues, Real Scalar>
[[nodiscard]] GainDesign<Scalar, tissues> design_gain(const PredictorDesign<Scalar>& design,
                                                      std::span<const Tissue<Scalar>> points,
                                                      const Tissue<Scalar>& centre,
                                                      const GainCertificate<Scalar, tissues>* neighbour) {
  for (const auto& tissue : points) design.check(tissue);
  GainCase<Scalar, tissues> given;
  given.design = design;
  resize(given.tissues, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) given.tissues[i] = points[i];
  given.box = {centre, centre};
  given.d = time_scale(design, centre);
  GainDesign<Scalar, tissues> result;
  if (neighbour && neighbour->verdict != Verdict::undecided) {
    GainLmi<Scalar, tissues, 1, false> lmi(given);
    const bool feasible = neighbour->verdict == Verdict::feasible;
    if (feasible ? lmi.proves_feasible(neighbour->variables, {neighbour->gain})
                 : lmi.proves_infeasible(neighbour->multipliers)) {
      result.verdict = neighbour->verdict;
      result.gain = neighbour->gain;
      result.certificate = *neighbour;
      result.reason = "neighbour's certificate";
      return result;
    }
  }
  decide_gain<Scalar>(given, result);
  return result;
}

}  // namespace detail

/// A gain with which Theorem 3, (4.31), has a solution at one tissue, or the proof that there is none.
///
/// The first gain found: any other between here and the border would do as well. gain_choice.hpp chooses among them.
/// Theorem 2, (4.17), is the same problem.
/// @param neighbour  certificate of a similar case: tried first
/// @realtime  allocates nothing, throws only on bad input; some tens of microseconds at most where the margin is above
///            1e-9; below it long double is asked, which allocates
/// @throws std::invalid_argument  where a setting cannot be used
template <Real Scalar>
[[nodiscard]] GainDesign<Scalar, 1> design_theorem3(const PredictorDesign<Scalar>& design, const Tissue<Scalar>& tissue,
                                                    const GainCertificate<Scalar, 1>* neighbour = nullptr) {
  return detail::design_gain<1>(design, std::span<const Tissue<Scalar>>(&tissue, 1), tissue, neighbour);
}

/// One gain for every tissue of a box, with common P, Q, R, X: tissues may change at any rate. Where infeasible there
/// is no such gain with a common X; `verify_theorem3`, which needs none, may still accept one.
template <Real Scalar>
[[nodiscard]] GainDesign<Scalar, 4> design_theorem3(const PredictorDesign<Scalar>& design, const TissueBox<Scalar>& box,
                                                    const GainCertificate<Scalar, 4>* neighbour = nullptr) {
  box.check();
  const auto corners = detail::vertices(box);
  return detail::design_gain<4>(design, std::span<const Tissue<Scalar>>(corners), box.centre(), neighbour);
}

/// One gain for all of some tissues, and all between them, with common P, Q, R, X. Off line: allocates.
template <Real Scalar>
[[nodiscard]] GainDesign<Scalar, Eigen::Dynamic> design_theorem3(
    const PredictorDesign<Scalar>& design, std::span<const Tissue<Scalar>> tissues,
    const GainCertificate<Scalar, Eigen::Dynamic>* neighbour = nullptr) {
  expect(!tissues.empty(), "design_theorem3: tissues", "at least one", tissues.size());
  for (const auto& tissue : tissues) design.check(tissue);
  return detail::design_gain<Eigen::Dynamic>(design, tissues, detail::centre_of(tissues), neighbour);
}

/// Theorem 2, (4.17): has the gain and the certificate of Theorem 3.
template <Real Scalar, typename Where>
[[nodiscard]] auto design_theorem2(const PredictorDesign<Scalar>& design, const Where& where) {
  return design_theorem3(design, where);
}

}  // namespace limpid
