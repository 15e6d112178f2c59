// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/gain_lmi.hpp>
#include <limpid/design/theorem3_design.hpp>

#include <string_view>

namespace limpid {

/// What proves a verdict of Theorem 5, in the coordinates of scaled_point.hpp; for a wider scalar's proof rounded.
template <Real Scalar = double>
struct ScheduledCertificate {
  Verdict verdict = Verdict::undecided;                 ///< what it proves
  detail::GainVariables<Scalar, 3> variables{};         ///< feasible: P_0, P_1, P_2, Q, R, X of the bars
  detail::GainMultipliers<Scalar, 4, 4> multipliers{};  ///< infeasible: Z > 0 at the vertices
};

template <Real Scalar = double>
struct ScheduledGainDesign {
  Verdict verdict = Verdict::undecided;
  AffineGain<Scalar> gain{};  ///< where feasible: L(rho); proved as it is here, rounded
  ScheduledCertificate<Scalar> certificate{};
  int iterations = 0;
  std::string_view reason{};  ///< how it was found, or why it was not

  [[nodiscard]] bool certified() const { return verdict != Verdict::undecided; }
};

namespace detail {

template <Real Scalar, bool gain_given, Real Given>
void decide_scheduled(const GainCase<Given, 4>& given, ScheduledGainDesign<Given>& result) {
  using Lmi = GainLmi<Scalar, 4, 3, gain_given>;
  const auto wide = given.template widened<Scalar>();
  auto lmi = [&] {
    if constexpr (gain_given) {
      const auto& L = result.gain;
      return Lmi(wide, {L.L0.template cast<Scalar>(), L.L1.template cast<Scalar>(), L.L2.template cast<Scalar>()});
    } else {
      return Lmi(wide);
    }
  }();
  GainVariables<Scalar, 3> variables;
  GainMultipliers<Scalar, 4, 4> multipliers;
  AffineGain<Given> gain = result.gain;
  const SdpStatus status = lmi.solve(variables, gain, multipliers, result.iterations);
  result.reason = describe(status);
  auto& certificate = result.certificate;
  if (status == SdpStatus::primal_certificate) {
    result.verdict = Verdict::feasible;
    result.gain = gain;
    for (std::size_t i = 0; i < 3; ++i) certificate.variables.P[i] = convert<Given>(variables.P[i]);
    certificate.variables.Q = convert<Given>(variables.Q);
    certificate.variables.R = convert<Given>(variables.R);
    certificate.variables.X = convert<Given>(variables.X);
  } else if (status == SdpStatus::dual_certificate) {
    result.verdict = Verdict::infeasible;
    certificate.multipliers.D = convert<Given>(multipliers.D);
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t sign = 0; sign < 4; ++sign) {
        certificate.multipliers.Z[k][sign] = convert<Given>(multipliers.Z[k][sign]);
      }
    }
  } else if constexpr (!std::is_void_v<Wider<Scalar>>) {
    decide_scheduled<Wider<Scalar>, gain_given>(given, result);
  }
  certificate.verdict = result.verdict;
}

template <Real Scalar>
[[nodiscard]] GainCase<Scalar, 4> scheduled_case(const PredictorDesign<Scalar>& design, const TissueBox<Scalar>& box,
                                                 const TissueRates<Scalar>& rates) {
  box.check();
  rates.check();
  GainCase<Scalar, 4> given;
  given.tissues = vertices(box);
  for (const auto& tissue : given.tissues) design.check(tissue);
  given.design = design;
  given.box = box;
  given.rates = rates;
  given.d = time_scale(design, box.centre());
  return given;
}

}  // namespace detail

/// A gain L(rho) = L0 + L1 k_e + L2 b_e with which Theorem 5, (4.51), holds on a whole box of tissues that change no
/// faster than `rates`, or the proof that there is none with P(rho) and Y(rho) affine.
///
/// With X constant (4.51) is affine in rho and in rho': the four vertices of the box with the four signs of the rates
/// say it for all between, no grid. A rate counts for a side of some width only; on one of none rho cannot change.
/// @realtime  allocates nothing, throws only on bad input; some hundreds of microseconds where the margin is above
///            1e-9; below it long double is asked, which allocates
/// @throws std::invalid_argument  where a setting cannot be used
template <Real Scalar>
[[nodiscard]] ScheduledGainDesign<Scalar> design_theorem5(const PredictorDesign<Scalar>& design,
                                                          const TissueBox<Scalar>& box,
                                                          const TissueRates<Scalar>& rates) {
  ScheduledGainDesign<Scalar> result;
  detail::decide_scheduled<Scalar, false>(detail::scheduled_case(design, box, rates), result);
  return result;
}

/// Whether Theorem 5 holds on the box for a gain that is given, with P(rho) affine.
/// @throws std::invalid_argument  where a setting cannot be used
template <Real Scalar>
[[nodiscard]] ScheduledGainDesign<Scalar> verify_theorem5(const PredictorDesign<Scalar>& design,
                                                          const TissueBox<Scalar>& box,
                                                          const TissueRates<Scalar>& rates,
                                                          const AffineGain<Scalar>& L) {
  L.check();
  ScheduledGainDesign<Scalar> result;
  result.gain = L;
  detail::decide_scheduled<Scalar, true>(detail::scheduled_case(design, box, rates), result);
  return result;
}

/// The thesis's step 1 of section 4.4.1: Theorem 5 at rho_0 alone.
///
/// There P_1 = P_2 = 0 is best, whatever the rates, and only L(rho_0) is determined, as by Theorem 3: of the affine
/// gains through it this is the one with the least sum of squares of L0, L1 k_0 and L2 b_0, L(rho) = L(rho_0) (1 +
/// k_e/k_0 + b_e/b_0)/3. How far it serves, `verify_theorem5` tells.
/// @throws std::invalid_argument  where a setting cannot be used
template <Real Scalar>
[[nodiscard]] ScheduledGainDesign<Scalar> design_theorem5_at_point(const PredictorDesign<Scalar>& design,
                                                                   const Tissue<Scalar>& rho_0) {
  const GainDesign<Scalar, 1> at_point = design_theorem3(design, rho_0);
  AffineGain<Scalar> gain;
  const bool by_stiffness = rho_0.stiffness != Scalar{0}, by_damping = rho_0.damping != Scalar{0};
  gain.L0 = at_point.gain / Scalar(1 + (by_stiffness ? 1 : 0) + (by_damping ? 1 : 0));
  if (by_stiffness) gain.L1 = gain.L0 / rho_0.stiffness;
  if (by_damping) gain.L2 = gain.L0 / rho_0.damping;
  ScheduledGainDesign<Scalar> result;
  if (at_point.verdict == Verdict::feasible) {
    result = verify_theorem5(design, TissueBox<Scalar>{rho_0, rho_0}, TissueRates<Scalar>{}, gain);  // as rounded
  } else {
    result.verdict = at_point.verdict;
    result.reason = at_point.reason;
  }
  result.iterations += at_point.iterations;
  return result;
}

}  // namespace limpid
