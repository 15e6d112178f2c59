// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/printed_theorems.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace limpid {

/// Theorem 5, (4.51), with P and Y affine in rho. Off line: allocates.
///
/// Both are written about the box's centre, P(rho) = P + P1 s1 + P2 s2 with s = (rho - centre)/half width in [-1, 1]:
/// other numbers for the same functions, all of one size. (4.51) is then affine in s for a constant X, and affine in
/// rho', so that the corners of the box and of the rates prove it everywhere.
template <Real Scalar = double>
struct PrintedTheorem5 {
  using Expression = LmiExpression<Scalar>;

  PrintedTheorem<Scalar> at_centre;  ///< P and Y there, and what does not depend on rho
  Expression P1, P2, Y1, Y2;         ///< by s1 and s2
  TissueBox<Scalar> box{};

  [[nodiscard]] Expression P(const BoxCorner& corner) const {
    return at_centre.P + Expression(corner.stiffness) * P1 + Expression(corner.damping) * P2;
  }
  [[nodiscard]] Expression Y(const BoxCorner& corner) const {
    return at_centre.Y + Expression(corner.stiffness) * Y1 + Expression(corner.damping) * Y2;
  }

  /// L(rho) = Y(rho) X'^-1.
  [[nodiscard]] AffineGain<Scalar> gain(const LmiResult<Scalar>& result) const {
    return detail::affine_gain(box, at_centre.gain(result), at_centre.gain(result, Y1), at_centre.gain(result, Y2));
  }
};

namespace detail {

template <Real Scalar>
void check_theorem5(const PredictorDesign<Scalar>& design, const TissueBox<Scalar>& box,
                    const TissueRates<Scalar>& rates) {
  box.check();
  rates.check();
  for (const BoxCorner& corner : box_corners) design.check(tissue_at(box, corner));
}

template <Real Scalar>
[[nodiscard]] PrintedTheorem5<Scalar> theorem5_variables(const PredictorDesign<Scalar>& design,
                                                         const TissueBox<Scalar>& box, bool free_gain,
                                                         Coordinates coordinates) {
  PrintedTheorem<Scalar> at_centre = printed_variables<Scalar>(true);
  at_centre.coordinates = coordinates;
  at_centre.d = time_scale(design, box.centre());
  at_centre.mass = design.tool.mass;
  auto P1 = zero<Scalar>(2, 2), P2 = P1, Y1 = zero<Scalar>(1, 2), Y2 = Y1;
  if (free_gain) at_centre.Y = at_centre.lmi.full("Y", 1, 2);
  if (box.lower.stiffness < box.upper.stiffness) {
    P1 = at_centre.lmi.symmetric("P1", 2);
    if (free_gain) Y1 = at_centre.lmi.full("Y1", 1, 2);
  }
  if (box.lower.damping < box.upper.damping) {
    P2 = at_centre.lmi.symmetric("P2", 2);
    if (free_gain) Y2 = at_centre.lmi.full("Y2", 1, 2);
  }
  return {std::move(at_centre), P1, P2, Y1, Y2, box};
}

}  // namespace detail

/// @param L  the six numbers; none: to be found
/// @throws std::invalid_argument  where the design, the box, the rates or the gain cannot be used
template <Real Scalar>
[[nodiscard]] PrintedTheorem5<Scalar> printed_theorem5(const PredictorDesign<Scalar>& design,
                                                       const TissueBox<Scalar>& box, const TissueRates<Scalar>& rates,
                                                       const std::optional<AffineGain<Scalar>>& L = std::nullopt,
                                                       Coordinates coordinates = Coordinates::scaled) {
  using Expression = LmiExpression<Scalar>;
  detail::check_theorem5(design, box, rates);
  if (L) L->check();
  auto theorem = detail::theorem5_variables(design, box, !L, coordinates);
  PrintedTheorem<Scalar>& v = theorem.at_centre;
  const Scalar unit = coordinates == Coordinates::scaled ? v.d : Scalar{1};
  const Expression rate1 =
      detail::rate_by_half_width(rates.stiffness, box.lower.stiffness, box.upper.stiffness, unit) * theorem.P1;
  const Expression rate2 =
      detail::rate_by_half_width(rates.damping, box.lower.damping, box.upper.damping, unit) * theorem.P2;
  for (const BoxCorner& corner : box_corners) {
    const Tissue<Scalar> rho = tissue_at(box, corner);
    const auto gain = L ? detail::enclosed_gain(*L, rho) : detail::Row2<Ball<Scalar>>{};
    const ErrorDynamics<Scalar> e(design, rho, gain, coordinates, v.d);
    const Expression Y = L ? Expression(e.L) * transpose(v.X) : theorem.Y(corner);
    for (const BoxCorner& sign : box_corners) {
      const Expression rate = Expression(sign.stiffness) * rate1 + Expression(sign.damping) * rate2;
      v.lmi.require(detail::printed_matrix(v, e, theorem.P(corner), Y, rate, identity<Scalar>(2)) < 0);
    }
    v.lmi.require(theorem.P(corner) > 0);
  }
  for (const Expression* positive : {&v.Q, &v.R, &v.S, &v.gamma}) v.lmi.require(*positive > 0);
  return theorem;
}

}  // namespace limpid
