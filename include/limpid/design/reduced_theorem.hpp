// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/printed_theorems.hpp>

namespace limpid::detail {

/// The left side of (4.17) and (4.51) with N at its optimum, and without S and gamma: 6 x 6.
///
/// N_1 = -R/T_d, N_2 = R/T_d, N_3 = 0 minimise N Pi + Pi'N' + T_d N R^-1 N', Pi = [I -I 0], in the order of matrices:
/// the square is completed, and -Pi'R Pi/T_d is left. S > 0 and gamma > 0 may be as small as a strict inequality lets
/// them.
/// @param AX, BY, X  barred A X', B Y, X; as they are M_1 A, M_1 B L, M_1'
/// @param more       what else Phi_11 has: sum +-|rho_i'|_max dP/drho_i, and S
template <Real Scalar>
[[nodiscard]] LmiExpression<Scalar> reduced_block(const ErrorDynamics<Scalar>& e, const LmiExpression<Scalar>& P,
                                                  const LmiExpression<Scalar>& Q, const LmiExpression<Scalar>& R,
                                                  const LmiExpression<Scalar>& AX, const LmiExpression<Scalar>& BY,
                                                  const LmiExpression<Scalar>& X, const LmiExpression<Scalar>& more) {
  using Expression = LmiExpression<Scalar>;
  const auto& [A, B, L, T_d, a2, a3] = e;
  const Expression by_T = (Ball<Scalar>(Scalar{1}) / T_d) * R;
  const Expression Phi11 = Q - by_T - AX - transpose(AX) + more;
  const Expression Phi21 = by_T - a2 * AX - transpose(BY);
  const Expression Phi22 = -Q - by_T - a2 * BY - a2 * transpose(BY);
  const Expression Phi31 = P - a3 * AX + X;
  const Expression Phi32 = a2 * X - a3 * BY;
  const Expression Phi33 = a3 * transpose(X) + a3 * X + T_d * R;
  return symmetric_block<Scalar>({{Phi11}, {Phi21, Phi22}, {Phi31, Phi32, Phi33}});
}

/// Barred.
/// @param rate  sum +-|rho_i'|_max dP/drho_i
template <Real Scalar>
[[nodiscard]] LmiExpression<Scalar> reduced_matrix(const ErrorDynamics<Scalar>& e, const LmiExpression<Scalar>& P,
                                                   const LmiExpression<Scalar>& Q, const LmiExpression<Scalar>& R,
                                                   const LmiExpression<Scalar>& X, const LmiExpression<Scalar>& Y,
                                                   const LmiExpression<Scalar>& rate) {
  return reduced_block<Scalar>(e, P, Q, R, e.A * transpose(X), e.B * Y, X, rate);
}

}  // namespace limpid::detail
