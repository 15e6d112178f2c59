// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/fixed_gain_lmi.hpp>
#include <limpid/design/reduced_lmi.hpp>
#include <limpid/design/scaled_point.hpp>

#include <array>
#include <cstddef>
#include <span>

/// Tissues at which the 6 x 6 block of reduced_lmi.hpp has to hold, and P(rho) and Y(rho) between them.
namespace limpid::detail {

/// P(rho) = P_0 + xi_1 P_1 + xi_2 P_2, xi = -1 and 1 at the sides of the box: eq. (4.50)'s form in coordinates without
/// units. With one term P is constant.
template <int terms>
using Weights = std::array<int, static_cast<std::size_t>(terms)>;

/// (1, xi_1, xi_2) at box corner i.
template <int terms>
[[nodiscard]] constexpr Weights<terms> weights_at(std::size_t i) {
  if constexpr (terms == 1) {
    return {1};
  } else {
    return {1, box_corners[i].stiffness, box_corners[i].damping};
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
    result.rate_by_half = {rate_by_half_width(rates.stiffness, box.lower.stiffness, box.upper.stiffness, d),
                           rate_by_half_width(rates.damping, box.lower.damping, box.upper.damping, d)};
    return result;
  }

  /// L' at each tissue, of a gain that is exact as it is.
  void set_gain(const AffineGain<Scalar>& gain, GainVertices<Ball<Scalar>, points>& vertices) const {
    for (std::size_t i = 0; i < tissues.size(); ++i) {
      vertices.L[i] = scale_gain(design, enclosed_gain(gain, tissues[i]), d);
    }
  }

  /// L0 + L1 k_e + L2 b_e of Y = L' X' at the centre and by xi.
  template <int terms>
  [[nodiscard]] AffineGain<Scalar> gain_of(const std::array<Row2<Scalar>, static_cast<std::size_t>(terms)>& Y,
                                           const Matrix2<Scalar>& X) const {
    const auto in_raw_units = [&](const Row2<Scalar>& part) {
      return detail::gain_of<Scalar>(X, part, design.tool.mass, d);
    };
    if constexpr (terms == 1) {
      AffineGain<Scalar> constant;
      constant.L0 = in_raw_units(Y[0]);
      return constant;
    } else {
      return affine_gain<Scalar>(box, in_raw_units(Y[0]), in_raw_units(Y[1]), in_raw_units(Y[2]));
    }
  }
};

}  // namespace limpid::detail
