// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/scaled_point.hpp>
#include <limpid/design/small_matrix.hpp>

/// Theorems 2, 3 and 5 with what can be eliminated by hand gone, in the coordinates of scaled_point.hpp. The verdict
/// is that of (4.17), (4.31) and (4.51); each < 0 is written here as a block that has to be > 0.
///
/// 1. S and gamma scale away: with gamma = epsilon and S = epsilon I the last row and column of (4.31) add
///    epsilon (E E' + diag(I, 0, 0)) to the rest, E = [I; a2 I; a3 I], which strictness permits. What is left is
///    (4.17).
/// 2. N = [N1; N2; N3] enters, after the Schur complement of -T R, as N Pi + Pi' N' + T N R^-1 N', Pi = [I -I 0]. In
///    the order of matrices its least value is -Pi' R Pi / T, at N = -Pi' R / T: N1 = -R/T, N2 = R/T, N3 = 0. Then
///
///        Xi = Xi0 + He(E M1 C),  Xi0 = [Q - R/T  R/T  P; R/T  -Q - R/T  0; P  0  T R],  C = [-A  -B L  I]
///
/// 3. L free: with X = M1^-1, Y = L X' and bars, Xi0 + He(E [-A X'  -B Y  X']) < 0, one block of 6 x 6.
/// 4. L fixed: M1 is there exactly when Xi0 is negative definite on the null spaces of E' and of C (Finsler's lemma),
///    spanned by E_perp = [-a2 I  -a3 I; I 0; 0 I] and C_perp = [I 0; 0 I; A  B L]: two blocks of 4 x 4 in P, Q, R.
namespace limpid::detail {

/// P, Q and R of (4.18), or their bars.
template <typename S>
struct LyapunovMatrices {
  Matrix2<S> P{}, Q{}, R{};
};

template <typename S, typename Other>
[[nodiscard]] LyapunovMatrices<S> convert(const LyapunovMatrices<Other>& m) {
  return {convert<S>(m.P), convert<S>(m.Q), convert<S>(m.R)};
}

template <typename S>
[[nodiscard]] bool proves_positive(const LyapunovMatrices<S>& m) {
  return proves_positive(m.P) && proves_positive(m.Q) && proves_positive(m.R);
}

/// -E_perp' Xi0 E_perp
template <typename S>
[[nodiscard]] Square<S, 4> block_of_multiplier(const LyapunovMatrices<S>& m, const ScaledDesign<S>& s) {
  const auto& [P, Q, R] = m;
  const S one(1), sum = s.a2 + one, R_by_T = one / s.T;
  Square<S, 4> F;
  set_block(F, 0, 0, R * (sum * sum * R_by_T) - Q * (s.a2 * s.a2 - one));
  set_block(F, 2, 0, (R * (sum * R_by_T) - Q * s.a2) * s.a3 + P * s.a2);
  set_block(F, 2, 2, (R * R_by_T - Q) * (s.a3 * s.a3) + P * (s.a3 + s.a3) - R * s.T);
  return F;
}

/// -C_perp' Xi0 C_perp
template <typename S>
[[nodiscard]] Square<S, 4> block_of_dynamics(const LyapunovMatrices<S>& m, const ScaledDesign<S>& s,
                                             const Matrix2<S>& A, const Row2<S>& L) {
  const auto& [P, Q, R] = m;
  const Matrix2<S> RA = R * A, R_by_T = R * (S(1) / s.T);
  Square<S, 4> F;
  set_block(F, 0, 0, R_by_T - Q - he(P * A) - transpose(A) * RA * s.T);
  set_block(F, 2, 0, -(R_by_T + outer(L, P.second_row() + RA.second_row() * s.T)));
  set_block(F, 2, 2, Q + R_by_T - outer(L, L * (R.a22 * s.T)));
  return F;
}

/// -(Xi0 + He(E [-A X'  -B Y  X'])); P_rate is what moves in (4.51)'s Phi_11.
template <typename S>
[[nodiscard]] Square<S, 6> block_with_gain(const LyapunovMatrices<S>& m, const ScaledDesign<S>& s, const Matrix2<S>& A,
                                           const Matrix2<S>& X, const Row2<S>& Y, const Matrix2<S>& P_rate) {
  const auto& [P, Q, R] = m;
  const S zero(0);
  const Matrix2<S> AX = A * transpose(X), BY{zero, zero, Y.first, Y.second}, R_by_T = R * (S(1) / s.T);
  Square<S, 6> F;
  set_block(F, 0, 0, R_by_T - Q + he(AX) - P_rate);
  set_block(F, 2, 0, AX * s.a2 + transpose(BY) - R_by_T);
  set_block(F, 2, 2, Q + R_by_T + he(BY) * s.a2);
  set_block(F, 4, 0, AX * s.a3 - P - X);
  set_block(F, 4, 2, BY * s.a3 - X * s.a2);
  set_block(F, 4, 4, -(he(X) * s.a3 + R * s.T));
  return F;
}

/// What Z, a multiplier of Xi0 in the 6 x 6 sense, leaves for those of P, Q, R > 0:
///
///     <-Xi0(P, Q, R), Z> + <P, Z_P> + <Q, Z_Q> + <R, Z_R> = 0  for all P, Q, R
///
/// If Z >= 0 and all three are positive definite there can be no P, Q, R > 0 with Xi0 < 0 where Z weighs it.
template <typename S>
[[nodiscard]] LyapunovMatrices<S> multipliers_left(const Square<S, 6>& Z, const ScaledDesign<S>& s) {
  const Matrix2<S> Z11 = get_block(Z, 0, 0), Z22 = get_block(Z, 2, 2);
  const Matrix2<S> difference = Z11 - he(get_block(Z, 2, 0)) + Z22;
  return {he(get_block(Z, 4, 0)), Z11 - Z22, get_block(Z, 4, 4) * s.T - difference * (S(1) / s.T)};
}

/// E_perp Z E_perp', of a multiplier of the first block of L fixed: with Z = sum of (u, w)(u, w)' it is that of z =
/// (-a2 u
/// - a3 w, u, w).
template <typename S>
[[nodiscard]] Square<S, 6> spread_multiplier(const Square<S, 4>& Z, const ScaledDesign<S>& s) {
  const Matrix2<S> U = get_block(Z, 0, 0), V = get_block(Z, 2, 0), W = get_block(Z, 2, 2);
  const Matrix2<S> u_first = -(U * s.a2 + transpose(V) * s.a3), w_first = -(V * s.a2 + W * s.a3);
  Square<S, 6> full;
  set_block(full, 0, 0, -(u_first * s.a2 + w_first * s.a3));
  set_block(full, 2, 0, u_first);
  set_block(full, 2, 2, U);
  set_block(full, 4, 0, w_first);
  set_block(full, 4, 2, V);
  set_block(full, 4, 4, W);
  return full;
}

/// C_perp Z C_perp', of one of the second: z = (u, w, A u + B L w).
template <typename S>
[[nodiscard]] Square<S, 6> spread_multiplier(const Square<S, 4>& Z, const Matrix2<S>& A, const Row2<S>& L) {
  const S zero(0);
  const Matrix2<S> U = get_block(Z, 0, 0), V = get_block(Z, 2, 0), W = get_block(Z, 2, 2),
                   BL{zero, zero, L.first, L.second};
  const Matrix2<S> last_u = A * U + BL * V, last_w = A * transpose(V) + BL * W;
  Square<S, 6> full;
  set_block(full, 0, 0, U);
  set_block(full, 2, 0, V);
  set_block(full, 2, 2, W);
  set_block(full, 4, 0, last_u);
  set_block(full, 4, 2, last_w);
  set_block(full, 4, 4, last_u * transpose(A) + last_w * transpose(BL));
  return full;
}

}  // namespace limpid::detail
