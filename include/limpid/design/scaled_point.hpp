// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/ball.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/small_matrix.hpp>

#include <Eigen/Core>

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
[[nodiscard]] Row2<S> scale_gain(const PredictorDesign<Scalar>& design, const Row2<S>& L, const Scalar& d) {
  const S per_velocity = S(design.tool.mass) * S(d);
  return {L.first / (per_velocity * S(d)), L.second / per_velocity};
}
template <typename S, Real Scalar>
[[nodiscard]] Row2<S> scale_gain(const PredictorDesign<Scalar>& design, const Gain<Scalar>& L, const Scalar& d) {
  return scale_gain(design, Row2<S>{S(L[0]), S(L[1])}, d);
}

/// L(rho) of the six numbers as they are: it may be much smaller than they are. A constant gain is exact.
template <Real Scalar>
[[nodiscard]] Row2<Ball<Scalar>> enclosed_gain(const AffineGain<Scalar>& L, const Tissue<Scalar>& rho) {
  const auto at = [&](int j) {
    Ball<Scalar> sum(L.L0[j]);
    if (L.L1[j] != Scalar{0}) sum += Ball<Scalar>(L.L1[j]) * Ball<Scalar>(rho.stiffness);
    if (L.L2[j] != Scalar{0}) sum += Ball<Scalar>(L.L2[j]) * Ball<Scalar>(rho.damping);
    return sum;
  };
  return {at(0), at(1)};
}

/// |rho_i'|_max over half the width of side i, in the time unit 1/d: what dP/drho_i weighs in (4.51) for a P that is
/// affine in (rho - centre)/half width. 0 for a side of none, on which rho cannot change.
template <Real Scalar>
[[nodiscard]] Ball<Scalar> rate_by_half_width(const Scalar& rate, const Scalar& lower, const Scalar& upper,
                                              const Scalar& d) {
  if (!(lower < upper)) return Ball<Scalar>(Scalar{0});
  return Ball<Scalar>(rate) * Ball<Scalar>(Scalar{2}) / ((Ball<Scalar>(upper) - Ball<Scalar>(lower)) * Ball<Scalar>(d));
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

/// L of L'; L' itself where the mass and d are 1.
template <Real Scalar>
[[nodiscard]] Gain<Scalar> unscale_gain(const Row2<Scalar>& L, const Scalar& mass, const Scalar& d) {
  const Scalar per_velocity = mass * d;
  return {L.first * per_velocity * d, L.second * per_velocity};
}

/// L of L' = Y X'^-1.
template <Real Scalar>
[[nodiscard]] Gain<Scalar> gain_of(const Matrix2<Scalar>& X, const Row2<Scalar>& Y, const Scalar& mass,
                                   const Scalar& d) {
  const Row2<Scalar> L{X.a22 * Y.first - X.a12 * Y.second, X.a11 * Y.second - X.a21 * Y.first};
  return unscale_gain(L * (Scalar{1} / (X.a11 * X.a22 - X.a12 * X.a21)), mass, d);
}
template <Real Scalar>
[[nodiscard]] Gain<Scalar> gain_of(const Eigen::Matrix<Scalar, 2, 2>& X, const Eigen::Matrix<Scalar, 1, 2>& Y,
                                   const Scalar& mass, const Scalar& d) {
  return gain_of(Matrix2<Scalar>{X(0, 0), X(0, 1), X(1, 0), X(1, 1)}, Row2<Scalar>{Y[0], Y[1]}, mass, d);
}

/// L(rho) = centre + xi_1 by_stiffness + xi_2 by_damping with xi = (rho - box's centre)/half width, as L0 + L1 k_e + L2
/// b_e. Along a side of no width it does not change.
template <Real Scalar>
[[nodiscard]] AffineGain<Scalar> affine_gain(const TissueBox<Scalar>& box, const Gain<Scalar>& centre,
                                             const Gain<Scalar>& by_stiffness, const Gain<Scalar>& by_damping) {
  const auto slope = [](const Gain<Scalar>& by_xi, const Scalar& lower, const Scalar& upper) -> Gain<Scalar> {
    if (!(lower < upper)) return Gain<Scalar>::Zero();
    return by_xi * (Scalar{2} / (upper - lower));
  };
  AffineGain<Scalar> gain;
  gain.L1 = slope(by_stiffness, box.lower.stiffness, box.upper.stiffness);
  gain.L2 = slope(by_damping, box.lower.damping, box.upper.damping);
  const Tissue<Scalar> middle = box.centre();
  gain.L0 = centre - (gain.L1 * middle.stiffness + gain.L2 * middle.damping);
  return gain;
}

}  // namespace limpid::detail
