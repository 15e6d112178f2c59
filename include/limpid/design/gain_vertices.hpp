// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/fixed_gain_lmi.hpp>
#include <limpid/design/reduced_lmi.hpp>

#include <array>
#include <cstddef>
#include <span>

/// Tissues at which the 6 x 6 block of reduced_lmi.hpp has to hold, and P(rho) and Y(rho) between them.
namespace limpid::detail {

/// P(rho) = P_0 + xi_1 P_1 + xi_2 P_2, xi = -1 and 1 at the sides of the box: eq. (4.50)'s form in coordinates without
/// units. With one term P is constant.
template <int terms>
using Weights = std::array<int, static_cast<std::size_t>(terms)>;

/// (1, xi_1, xi_2) at vertex i of detail::vertices.
template <int terms>
[[nodiscard]] constexpr Weights<terms> weights_at(std::size_t i) {
  if constexpr (terms == 1) {
    return {1};
  } else {
    return {1, i % 2 == 0 ? -1 : 1, i / 2 % 2 == 0 ? -1 : 1};
  }
}

template <typename Matrix, int terms>
[[nodiscard]] Matrix combine(const std::array<Matrix, static_cast<std::size_t>(terms)>& parts,
                             const Weights<terms>& weights) {
  Matrix sum = parts[0];
  for (std::size_t i = 1; i < parts.size(); ++i) {
    sum = weights[i] > 0 ? sum + parts[i] : sum - parts[i];
  }
  return sum;
}

/// P, Q, R, X of the bars; Y follows from the gain.
template <Real Scalar, int terms>
struct GainVariables {
  std::array<Matrix2<Scalar>, static_cast<std::size_t>(terms)> P{};
  Matrix2<Scalar> Q{}, R{}, X{};
};

/// Multipliers Z of the 6 x 6 blocks, one for each vertex and each sign of the rates; and what is free to choose in
/// those of P(rho) > 0 (terms > 1).
template <Real Scalar, int points, int signs>
struct GainMultipliers {
  PerTissue<std::array<Square<Scalar, 6>, static_cast<std::size_t>(signs)>, points> Z{};
  Matrix2<Scalar> D{};
};

/// A box or some tissues, scaled, in doubles and in balls. S: Scalar or Ball<Scalar>.
template <typename S, int points>
struct GainVertices {
  ScaledDesign<S> s{};
  PerTissue<Matrix2<S>, points> A{};
  PerTissue<Row2<S>, points> L{};   // where the gain is given
  std::array<S, 2> rate_by_half{};  // |rho_i'|_max over the half width of side i, by scaled time; 0 for a side of none
};

template <Real Scalar, int points>
[[nodiscard]] GainVertices<Scalar, points> centres(const GainVertices<Ball<Scalar>, points>& balls) {
  GainVertices<Scalar, points> result;
  result.s = {balls.s.T.centre(), balls.s.a2.centre(), balls.s.a3.centre()};
  resize(result.A, balls.A.size());
  resize(result.L, balls.L.size());
  for (std::size_t i = 0; i < balls.A.size(); ++i) {
    result.A[i] = centre_of_each(balls.A[i]);
    result.L[i] = centre_of_each(balls.L[i]);
  }
  for (std::size_t i = 0; i < 2; ++i) result.rate_by_half[i] = balls.rate_by_half[i].centre();
  return result;
}

/// Physical tissues, box and rates in a scalar that holds what was given exactly.
template <Real Scalar, int points>
struct GainCase {
  PredictorDesign<Scalar> design{};
  PerTissue<Tissue<Scalar>, points> tissues{};
  TissueBox<Scalar> box{};      // around the tissues
  TissueRates<Scalar> rates{};  // of theorem 5
  Scalar d{};                   // of scaled_point.hpp

  template <Real Wide, int wide_points = points>
  [[nodiscard]] GainCase<Wide, wide_points> widened() const {
    const auto widen_tissue = [](const Tissue<Scalar>& tissue) {
      return Tissue<Wide>{Wide(tissue.stiffness), Wide(tissue.damping)};
    };
    GainCase<Wide, wide_points> wide;
    wide.design = widen<Wide>(design);
    resize(wide.tissues, tissues.size());
    for (std::size_t i = 0; i < tissues.size(); ++i) wide.tissues[i] = widen_tissue(tissues[i]);
    wide.box = {widen_tissue(box.lower), widen_tissue(box.upper)};
    wide.rates = {Wide(rates.stiffness), Wide(rates.damping)};
    wide.d = Wide(d);
    return wide;
  }

  [[nodiscard]] GainVertices<Ball<Scalar>, points> scaled() const {
    using B = Ball<Scalar>;
    GainVertices<B, points> result;
    result.s = scale_design<B>(design, d);
    resize(result.A, tissues.size());
    resize(result.L, tissues.size());
    for (std::size_t i = 0; i < tissues.size(); ++i) result.A[i] = scale_dynamics<B>(design, tissues[i], d);
    const auto by_half = [&](const Scalar& rate, const Scalar& lower, const Scalar& upper) {
      return upper > lower ? B(rate) * B(Scalar{2}) / ((B(upper) - B(lower)) * B(d)) : B(Scalar{0});
    };
    result.rate_by_half = {by_half(rates.stiffness, box.lower.stiffness, box.upper.stiffness),
                           by_half(rates.damping, box.lower.damping, box.upper.damping)};
    return result;
  }

  /// L' at each tissue, of a gain that is exact as it is.
  void set_gain(const AffineGain<Scalar>& gain, GainVertices<Ball<Scalar>, points>& vertices) const {
    using B = Ball<Scalar>;
    const B per_velocity = B(design.tool.mass) * B(d);
    for (std::size_t i = 0; i < tissues.size(); ++i) {
      const B k(tissues[i].stiffness), b(tissues[i].damping);
      const auto at = [&](int j) { return B(gain.L0[j]) + B(gain.L1[j]) * k + B(gain.L2[j]) * b; };
      vertices.L[i] = {at(0) / (per_velocity * B(d)), at(1) / per_velocity};
    }
  }

  /// L0 + L1 k_e + L2 b_e of Y = L' X' at the centre and by xi.
  template <int terms>
  [[nodiscard]] AffineGain<Scalar> gain_of(const std::array<Row2<Scalar>, static_cast<std::size_t>(terms)>& Y,
                                           const Matrix2<Scalar>& X) const {
    const Scalar determinant = X.a11 * X.a22 - X.a12 * X.a21;
    const Matrix2<Scalar> inverse = Matrix2<Scalar>{X.a22, -X.a21, -X.a12, X.a11} * (Scalar{1} / determinant);  // of X'
    AffineGain<Scalar> gain;
    gain.L0 = unscale_gain<Scalar>(design, Y[0] * inverse, d);
    if constexpr (terms > 1) {
      const auto slope = [&](const Row2<Scalar>& part, const Scalar& lower, const Scalar& upper) -> Gain<Scalar> {
        if (!(upper > lower)) return Gain<Scalar>::Zero();
        return unscale_gain<Scalar>(design, part * inverse, d) * (Scalar{2} / (upper - lower));
      };
      gain.L1 = slope(Y[1], box.lower.stiffness, box.upper.stiffness);
      gain.L2 = slope(Y[2], box.lower.damping, box.upper.damping);
      const Tissue<Scalar> centre = box.centre();
      gain.L0 -= gain.L1 * centre.stiffness + gain.L2 * centre.damping;
    }
    return gain;
  }
};

}  // namespace limpid::detail
