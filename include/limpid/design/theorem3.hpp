// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/fixed_gain_lmi.hpp>

#include <span>
#include <string_view>

namespace limpid {

/// What proves a verdict of `verify_theorem3`, in the coordinates of scaled_point.hpp; for a wider scalar's proof
/// rounded.
template <Real Scalar = double, int tissues = 1>
struct Theorem3Certificate {
  Verdict verdict = Verdict::undecided;                         ///< what it proves
  detail::LyapunovMatrices<Scalar> lyapunov{};                  ///< feasible: P, Q, R
  detail::FixedGainMultipliers<Scalar, tissues> multipliers{};  ///< infeasible: Z > 0 of the two kinds of block
};

template <Real Scalar = double, int tissues = 1>
struct Theorem3Verdict {
  Verdict verdict = Verdict::undecided;
  Theorem3Certificate<Scalar, tissues> certificate{};
  int iterations = 0;         ///< of the solver; 0 where a neighbour's certificate served
  std::string_view reason{};  ///< how it was found, or why it was not

  [[nodiscard]] bool certified() const { return verdict != Verdict::undecided; }
};

namespace detail {

template <int tissues, Real Scalar>
[[nodiscard]] bool holds(const FixedGainLmi<Scalar, tissues>& lmi, const Theorem3Certificate<Scalar, tissues>& known) {
  switch (known.verdict) {
    case Verdict::feasible:
      return lmi.proves_feasible(known.lyapunov);
    case Verdict::infeasible:
      return lmi.proves_infeasible(known.multipliers);
    default:
      return false;
  }
}

// Solved in Scalar, and where that leaves it open in the next wider one.
template <Real Scalar, int tissues, Real Given, typename Lmi>
void decide_fixed_gain(const Lmi& make_lmi, Theorem3Verdict<Given, tissues>& result) {
  constexpr int points = points_solved<Scalar, tissues>;
  const auto lmi = make_lmi.template operator()<Scalar, points>();
  LyapunovMatrices<Scalar> lyapunov;
  FixedGainMultipliers<Scalar, points> multipliers;
  const SdpStatus status = lmi.solve(lyapunov, multipliers, result.iterations);
  result.reason = describe(status);
  if (status == SdpStatus::primal_certificate) {
    result.verdict = Verdict::feasible;
    result.certificate.lyapunov = convert<Given>(lyapunov);
  } else if (status == SdpStatus::dual_certificate) {
    result.verdict = Verdict::infeasible;
    auto& rounded = result.certificate.multipliers;
    rounded.Z_multiplier = convert<Given>(multipliers.Z_multiplier);
    resize(rounded.Z_dynamics, multipliers.Z_dynamics.size());
    for (std::size_t i = 0; i < multipliers.Z_dynamics.size(); ++i) {
      rounded.Z_dynamics[i] = convert<Given>(multipliers.Z_dynamics[i]);
    }
  } else if constexpr (!std::is_void_v<Wider<Scalar>>) {
    decide_fixed_gain<Wider<Scalar>>(make_lmi, result);
  }
  result.certificate.verdict = result.verdict;
}

template <int tissues, Real Scalar>
[[nodiscard]] Theorem3Verdict<Scalar, tissues> verify_fixed_gain(
    const PredictorDesign<Scalar>& design, std::span<const Tissue<Scalar>> points, const Tissue<Scalar>& centre,
    const Gain<Scalar>& L, const Theorem3Certificate<Scalar, tissues>* neighbour) {
  for (const auto& tissue : points) design.check(tissue);
  expect(is_finite(L), "Gain: L", "finite", L);
  const Scalar d = time_scale(design, centre);
  const auto make_lmi = [&]<typename S, int count>() { return FixedGainLmi<S, count>(design, points, L, d); };
  Theorem3Verdict<Scalar, tissues> result;
  if (neighbour && holds<tissues>(make_lmi.template operator()<Scalar, tissues>(), *neighbour)) {
    result.verdict = neighbour->verdict;
    result.certificate = *neighbour;
    result.reason = "neighbour's certificate";
    return result;
  }
  decide_fixed_gain<Scalar>(make_lmi, result);
  return result;
}

template <Real Scalar>
[[nodiscard]] Tissue<Scalar> centre_of(std::span<const Tissue<Scalar>> points) {
  TissueBox<Scalar> hull{points.front(), points.front()};
  for (const auto& [stiffness, damping] : points) {
    hull.lower.stiffness = std::min<Scalar>(hull.lower.stiffness, stiffness);
    hull.upper.stiffness = std::max<Scalar>(hull.upper.stiffness, stiffness);
    hull.lower.damping = std::min<Scalar>(hull.lower.damping, damping);
    hull.upper.damping = std::max<Scalar>(hull.upper.damping, damping);
  }
  return hull.centre();
}

}  // namespace detail

/// Whether Theorem 3, (4.31), has a solution for the gain L at one tissue; every verdict but `undecided` is proved,
/// with all rounding accounted for, by the certificate.
///
/// gamma does not matter, and Theorem 2, (4.17), has the same verdict: both are pure scale (reduced_lmi.hpp).
/// @param L          N/m, N s/m
/// @param neighbour  certificate of a similar case: tried first, at a tenth of the cost
/// @realtime  allocates nothing, throws only on bad input; a few to some tens of microseconds, more where the margin is
///            below 1e-9 and long double is asked
/// @throws std::invalid_argument  where a setting cannot be used
template <Real Scalar>
[[nodiscard]] Theorem3Verdict<Scalar, 1> verify_theorem3(const PredictorDesign<Scalar>& design,
                                                         const Tissue<Scalar>& tissue, const Gain<Scalar>& L,
                                                         const Theorem3Certificate<Scalar, 1>* neighbour = nullptr) {
  return detail::verify_fixed_gain<1>(design, std::span<const Tissue<Scalar>>(&tissue, 1), tissue, L, neighbour);
}

/// The same for every tissue of a box at once, with common P, Q, R, so that tissues may change at any rate: at the
/// box's four vertices, between which it holds too.
///
/// V of (4.18) falls, whichever tissue there is. X = M1^-1 is eliminated for each tissue and so may be another one for
/// each: less is asked than by `design_theorem3` and by the margins and bounds, which have one X for all, as in print,
/// and may be infeasible where this is not.
template <Real Scalar>
[[nodiscard]] Theorem3Verdict<Scalar, 4> verify_theorem3(const PredictorDesign<Scalar>& design,
                                                         const TissueBox<Scalar>& box, const Gain<Scalar>& L,
                                                         const Theorem3Certificate<Scalar, 4>* neighbour = nullptr) {
  box.check();
  const auto corners = detail::vertices(box);
  return detail::verify_fixed_gain<4>(design, std::span<const Tissue<Scalar>>(corners), box.centre(), L, neighbour);
}

/// The same for all of some tissues, and all between them, with common P, Q, R. Off line: allocates.
template <Real Scalar>
[[nodiscard]] Theorem3Verdict<Scalar, Eigen::Dynamic> verify_theorem3(
    const PredictorDesign<Scalar>& design, std::span<const Tissue<Scalar>> tissues, const Gain<Scalar>& L,
    const Theorem3Certificate<Scalar, Eigen::Dynamic>* neighbour = nullptr) {
  expect(!tissues.empty(), "verify_theorem3: tissues", "at least one", tissues.size());
  for (const auto& tissue : tissues) design.check(tissue);
  return detail::verify_fixed_gain<Eigen::Dynamic>(design, tissues, detail::centre_of(tissues), L, neighbour);
}

/// Theorem 2, (4.17): has the verdict and the certificate of Theorem 3.
template <Real Scalar, typename Where, int tissues = 1>
[[nodiscard]] auto verify_theorem2(const PredictorDesign<Scalar>& design, const Where& where, const Gain<Scalar>& L,
                                   const Theorem3Certificate<Scalar, tissues>* neighbour = nullptr) {
  return verify_theorem3(design, where, L, neighbour);
}

}  // namespace limpid
