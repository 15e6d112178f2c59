// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/printed_theorem5.hpp>
#include <limpid/design/printed_theorems.hpp>

#include <optional>
#include <span>

namespace limpid {

/// How well a theorem holds: the largest t with
///
///     -F >= t I;   P, Q, R, S >= t I;   gamma >= t;   tr(P + Q + R + S) + gamma = 1
///
/// in the scaled coordinates, F the printed left side; below 0 where the theorem does not hold. Theorem 2 has no S and
/// gamma; in Theorem 5 the trace is of P at the box's centre, and P >= t I at its corners.
template <Real Scalar = double>
struct PredictorMargin {
  Scalar margin{0};  ///< no larger than the true one; proved
  Scalar bound{0};   ///< no smaller; proved; infinite where no bound was
  Verdict verdict = Verdict::undecided;
};

namespace detail {

template <Real Scalar>
void ask_for_margin(PrintedTheorem<Scalar>& theorem) {
  theorem.lmi.normalise(trace(theorem.P) + trace(theorem.Q) + trace(theorem.R) + trace(theorem.S) + theorem.gamma == 1);
  theorem.lmi.maximise_margin();
}

template <Real Scalar>
[[nodiscard]] PredictorMargin<Scalar> margin_of(PrintedTheorem<Scalar>& theorem) {
  ask_for_margin(theorem);
  const LmiResult<Scalar> result = theorem.lmi.solve();
  return {result.margin, result.margin_bound, result.verdict};
}

}  // namespace detail

/// Of Theorem 2 at each of the tissues, with common variables.
/// @param L  none: the largest margin of any gain
/// Off line: allocates; some ms.
/// @throws std::invalid_argument  where the design or a tissue cannot be used
template <Real Scalar>
[[nodiscard]] PredictorMargin<Scalar> theorem2_margin(const PredictorDesign<Scalar>& design,
                                                      std::span<const Tissue<Scalar>> tissues,
                                                      const std::optional<Gain<Scalar>>& L = std::nullopt) {
  auto theorem = printed_theorem2(design, tissues, L);
  return detail::margin_of(theorem);
}

/// Of Theorem 3, likewise.
template <Real Scalar>
[[nodiscard]] PredictorMargin<Scalar> theorem3_margin(const PredictorDesign<Scalar>& design,
                                                      std::span<const Tissue<Scalar>> tissues,
                                                      const std::optional<Gain<Scalar>>& L = std::nullopt) {
  auto theorem = printed_theorem3(design, tissues, L);
  return detail::margin_of(theorem);
}
template <Real Scalar>
[[nodiscard]] PredictorMargin<Scalar> theorem3_margin(const PredictorDesign<Scalar>& design,
                                                      const Tissue<Scalar>& tissue,
                                                      const std::optional<Gain<Scalar>>& L = std::nullopt) {
  return theorem3_margin<Scalar>(design, std::span<const Tissue<Scalar>>(&tissue, 1), L);
}
template <Real Scalar>
[[nodiscard]] PredictorMargin<Scalar> theorem2_margin(const PredictorDesign<Scalar>& design,
                                                      const Tissue<Scalar>& tissue,
                                                      const std::optional<Gain<Scalar>>& L = std::nullopt) {
  return theorem2_margin<Scalar>(design, std::span<const Tissue<Scalar>>(&tissue, 1), L);
}

/// Of Theorem 5 over the box and the rates.
template <Real Scalar>
[[nodiscard]] PredictorMargin<Scalar> theorem5_margin(const PredictorDesign<Scalar>& design,
                                                      const TissueBox<Scalar>& box, const TissueRates<Scalar>& rates,
                                                      const std::optional<AffineGain<Scalar>>& L = std::nullopt) {
  auto theorem = printed_theorem5(design, box, rates, L);
  return detail::margin_of(theorem.at_centre);
}

}  // namespace limpid
