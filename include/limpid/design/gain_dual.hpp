// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/gain_vertices.hpp>

#include <array>
#include <cstddef>

/// Proof that the 6 x 6 blocks of gain_lmi.hpp have no solution: Z_ks > 0 for each vertex k and sign s of the rates.
/// With Z_k = sum_s Z_ks and its K_j = Z_1j + a2 Z_2j + a3 Z_3j they have to annihilate every variable:
///
///     X:          sum_k K_3 - A' K_1 = 0,  where L is given less L' (second row of K_2)
///     Y_i:        sum_k xi_i (second row of K_2) = 0
///     Q, R:       what is left for Q > 0 and R > 0 is positive definite (multipliers_left)
///     P_0, P_i:   sum_k W_k = sum_k G_k,  sum_k xi_i W_k = sum_k xi_i G_k + H_i
///
/// where W_k > 0 belongs to P(rho_k) > 0, G_k = Z_31 + Z_31' and H_i = sum_ks +-|rho_i'| Z_11. At the vertices of a box
/// the last is solved by W_k = G_k + (xi_1 H_1 + xi_2 H_2)/4 + xi_1 xi_2 D for any D.
///
/// A solver's Z satisfies the first two up to rounding. They are solved exactly, in balls, for what is to be added to
/// Z_31 of every vertex alike and to the second row of Z_32.
namespace limpid::detail {

/// N V' - a3 A' V = R for A = [0 N; alpha beta].
template <typename S>
[[nodiscard]] Matrix2<S> solve_for_correction(const S& N, const Matrix2<S>& A, const S& a3, const Matrix2<S>& R) {
  const S by_N = S(1) / N, a3_alpha = a3 * A.a21 * by_N, a3_beta = a3 * A.a22 * by_N;
  // Entries as constant + slope v22, from the top right entry of the equation on.
  const S v21_0 = R.a12 * by_N, v21_1 = a3_alpha;
  const S v11_0 = R.a11 * by_N + a3_alpha * v21_0, v11_1 = a3_alpha * v21_1;
  const S v12_0 = R.a21 * by_N + a3 * v11_0 + a3_beta * v21_0, v12_1 = a3 * v11_1 + a3_beta * v21_1;
  const S v22 = (R.a22 * by_N + a3 * v12_0) / (S(1) - a3_beta - a3 * v12_1);
  return {v11_0 + v11_1 * v22, v12_0 + v12_1 * v22, v21_0 + v21_1 * v22, v22};
}

/// What is to be added to the Z_31 and to the second row of Z_32 of one of the blocks.
template <typename S, int points>
struct MultiplierCorrection {
  Matrix2<S> V{};
  PerTissue<Row2<S>, points> u{};
};

template <int terms, bool gain_given, Real Scalar, int points, int signs>
[[nodiscard]] MultiplierCorrection<Ball<Scalar>, points> correction_of(
    const GainVertices<Ball<Scalar>, points>& v, const GainMultipliers<Scalar, points, signs>& m) {
  using B = Ball<Scalar>;
  const std::size_t vertices = m.Z.size();
  const B number(static_cast<Scalar>(vertices)), zero(Scalar{0});
  const auto &a2 = v.s.a2, &a3 = v.s.a3;
  Matrix2<B> rest_of_X{}, sum_of_A{};
  std::array<Row2<B>, static_cast<std::size_t>(terms)> rest_of_Y{};
  for (std::size_t k = 0; k < vertices; ++k) {
    Square<B, 6> Z = convert<B>(m.Z[k][0]);
    for (std::size_t sign = 1; sign < signs; ++sign) add(Z, convert<B>(m.Z[k][sign]));
    const auto K = [&](int j) {
      return get_block(Z, 0, 2 * j) + get_block(Z, 2, 2 * j) * a2 + get_block(Z, 4, 2 * j) * a3;
    };
    const Row2<B> row = K(1).second_row();
    rest_of_X = rest_of_X + K(2) - transpose(v.A[k]) * K(0);
    sum_of_A = sum_of_A + v.A[k];
    if constexpr (gain_given) {
      rest_of_X = rest_of_X - outer(v.L[k], row);
    } else {
      const auto weights = weights_at<terms>(k);
      for (std::size_t i = 0; i < rest_of_Y.size(); ++i) rest_of_Y[i] = rest_of_Y[i] + row * B(Scalar(weights[i]));
    }
  }
  MultiplierCorrection<B, points> result;
  resize(result.u, vertices);
  if constexpr (!gain_given) {
    const B share = B(Scalar{-1}) / (a3 * number);
    for (std::size_t k = 0; k < vertices; ++k) {
      const auto weights = weights_at<terms>(k);
      Row2<B> sum{};
      for (std::size_t i = 0; i < rest_of_Y.size(); ++i) sum = sum + rest_of_Y[i] * B(Scalar(weights[i]));
      result.u[k] = sum * share;
      rest_of_X = rest_of_X + Matrix2<B>{zero, result.u[k].first, zero, result.u[k].second} * a2;
    }
  }
  const B per_sign(Scalar{1} / Scalar(signs));  // a power of two: exact
  result.V = solve_for_correction(number, sum_of_A, a3, -rest_of_X) * per_sign;
  for (auto& u : result.u) u = u * per_sign;
  return result;
}

/// Whether the multipliers prove that there is no solution, rounding accounted for.
template <int terms, bool gain_given, Real Scalar, int points, int signs>
[[nodiscard, gnu::noinline]] bool gain_multipliers_prove(const GainVertices<Ball<Scalar>, points>& v,
                                                         const GainMultipliers<Scalar, points, signs>& m) {
  using B = Ball<Scalar>;
  if (m.Z.size() != v.A.size()) return false;
  for (const auto& at_vertex : m.Z) {  // most fail here
    for (const auto& Z : at_vertex) {
      if (!proves_positive(Z)) return false;
    }
  }
  const auto correction = correction_of<terms, gain_given>(v, m);
  const B zero(Scalar{0});
  Square<B, 6> total{};
  PerTissue<Matrix2<B>, points> G;
  resize(G, m.Z.size());
  std::array<Matrix2<B>, 2> H{};
  for (std::size_t k = 0; k < m.Z.size(); ++k) {
    Square<B, 6> here{};
    const Matrix2<B> U{zero, zero, correction.u[k].first, correction.u[k].second};
    for (std::size_t sign = 0; sign < signs; ++sign) {
      Square<B, 6> Z = convert<B>(m.Z[k][sign]);
      set_block(Z, 4, 0, get_block(Z, 4, 0) + correction.V);
      set_block(Z, 4, 2, get_block(Z, 4, 2) + U);
      if (!proves_positive(Z)) return false;
      add(here, Z);
      if constexpr (terms > 1) {
        for (std::size_t i = 0; i < 2; ++i) {
          const bool negative = i == 0 ? sign % 2 == 0 : sign / 2 == 0;
          const Matrix2<B> rate = get_block(Z, 0, 0) * v.rate_by_half[i];
          H[i] = negative ? H[i] - rate : H[i] + rate;
        }
      }
    }
    G[k] = he(get_block(here, 4, 0));
    add(total, here);
  }
  const auto left = multipliers_left(total, v.s);
  if (!proves_positive(left.Q) || !proves_positive(left.R)) return false;
  if constexpr (terms == 1) {
    return proves_positive(left.P);
  } else {
    const B quarter(Scalar{1} / Scalar{4});
    for (std::size_t k = 0; k < G.size(); ++k) {
      const auto weights = weights_at<terms>(k);
      const Matrix2<B> W = G[k] + (H[0] * B(Scalar(weights[1])) + H[1] * B(Scalar(weights[2]))) * quarter +
                           convert<B>(m.D) * B(Scalar(weights[1] * weights[2]));
      if (!proves_positive(W)) return false;
    }
    return true;
  }
}

}  // namespace limpid::detail
