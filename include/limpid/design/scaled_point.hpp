// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/ball.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/small_matrix.hpp>

#include <cmath>

/// The error dynamics (4.16) in coordinates in which the LMIs are well conditioned.
///
///     e = D e',  D = diag(1, d),  time in units of 1/d,  d = sqrt((k_t + k_e)/m_t)
///     A' = D^-1 A D / d = [0 1; -(k_t + k_e)/(m_t d^2) -(b_t + b_e)/(m_t d)],  B' = (0, 1)',  L' = L D/(m_t d^2),
///     T_d' = d T_d,  a_3' = d a_3
///
/// They hold for every d > 0, so that a rounded one is exact; one d serves several tissues.
namespace limpid::detail {

/// What depends on the design alone. S: a real scalar, or a Ball where rounding is to be accounted for.
template <typename S>
struct ScaledDesign {
  S T, a2, a3;
};

template <typename S, Real Scalar>
[[nodiscard]] ScaledDesign<S> scale_design(const PredictorDesign<Scalar>& design, const Scalar& d) {
  return {S(d) * S(design.T_d), S(design.a2), S(d) * S(design.a3)};
}

template <Real Scalar>
[[nodiscard]] Scalar time_scale(const PredictorDesign<Scalar>& design, const Tissue<Scalar>& tissue) {
  using std::sqrt;
  return sqrt((design.tool.stiffness + tissue.stiffness) / design.tool.mass);
}

/// A'
template <typename S, Real Scalar>
[[nodiscard]] Matrix2<S> scale_dynamics(const PredictorDesign<Scalar>& design, const Tissue<Scalar>& tissue,
                                        const Scalar& d) {
  const S per_velocity = S(design.tool.mass) * S(d);
  const S stiffness = S(design.tool.stiffness) + S(tissue.stiffness);
  const S damping = S(design.tool.damping) + S(tissue.damping);
  return {S(Scalar{0}), S(Scalar{1}), -(stiffness / (per_velocity * S(d))), -(damping / per_velocity)};
}

/// L'
template <typename S, Real Scalar>
[[nodiscard]] Row2<S> scale_gain(const PredictorDesign<Scalar>& design, const Gain<Scalar>& L, const Scalar& d) {
  const S per_velocity = S(design.tool.mass) * S(d);
  return {S(L[0]) / (per_velocity * S(d)), S(L[1]) / per_velocity};
}

/// The same design in a scalar that holds its numbers exactly.
template <Real Scalar, Real Given>
[[nodiscard]] PredictorDesign<Scalar> widen(const PredictorDesign<Given>& design) {
  PredictorDesign<Scalar> wide;
  wide.tool.mass = Scalar(design.tool.mass);
  wide.tool.damping = Scalar(design.tool.damping);
  wide.tool.stiffness = Scalar(design.tool.stiffness);
  wide.T_d = Scalar(design.T_d);
  wide.a2 = Scalar(design.a2);
  wide.a3 = Scalar(design.a3);
  return wide;
}

/// L of L'
template <Real Scalar>
[[nodiscard]] Gain<Scalar> unscale_gain(const PredictorDesign<Scalar>& design, const Row2<Scalar>& L, const Scalar& d) {
  const Scalar per_velocity = design.tool.mass * d;
  return {L.first * per_velocity * d, L.second * per_velocity};
}

}  // namespace limpid::detail
