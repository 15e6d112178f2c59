// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/printed_theorems.hpp>

namespace limpid::detail {

/// The left side of (4.17) and (4.51) with N at its optimum, and without S and gamma: 6 x 6, barred.
///
/// N_1 = -R/T_d, N_2 = R/T_d, N_3 = 0 minimise N Pi + Pi'N' + T_d N R^-1 N', Pi = [I -I 0], in the order of matrices:
/// the square is completed, and -Pi'R Pi/T_d is left. S > 0 and gamma > 0 may be as small as a strict inequality lets
/// them.
/// @param rate  sum +-|rho_i'|_max dP/drho_i
template <Real Scalar>
[[nodiscard]] LmiExpression<Scalar> reduced_matrix(const ErrorDynamics<Scalar>& e, const LmiExpression<Scalar>& P,
                                                   const LmiExpression<Scalar>& Q, const LmiExpression<Scalar>& R,
                                                   const LmiExpression<Scalar>& X, const LmiExpression<Scalar>& Y,
                                                   const LmiExpression<Scalar>& rate) {
  using Expression = LmiExpression<Scalar>;
  const auto& [A, B, L, T_d, a2, a3] = e;
  const Expression AX = A * transpose(X), BY = B * Y, by_T = (Ball<Scalar>(Scalar{1}) / T_d) * R;
  const Expression Phi11 = Q - by_T - AX - transpose(AX) + rate;
  const Expression Phi21 = by_T - a2 * AX - transpose(BY);
  const Expression Phi22 = -Q - by_T - a2 * BY - a2 * transpose(BY);
  const Expression Phi31 = P - a3 * AX + X;
  const Expression Phi32 = a2 * X - a3 * BY;
  const Expression Phi33 = a3 * transpose(X) + a3 * X + T_d * R;
  return symmetric_block<Scalar>({{Phi11}, {Phi21, Phi22}, {Phi31, Phi32, Phi33}});
}

/// L = Y X'^-1, from the scaled coordinates to raw units.
template <Real Scalar>
[[nodiscard]] Gain<Scalar> gain_of(const Eigen::Matrix<Scalar, 2, 2>& X, const Eigen::Matrix<Scalar, 1, 2>& Y,
                                   const Scalar& mass, const Scalar& d) {
  const Scalar unit = mass * d / (X(0, 0) * X(1, 1) - X(0, 1) * X(1, 0));
  return {(X(1, 1) * Y[0] - X(0, 1) * Y[1]) * unit * d, (X(0, 0) * Y[1] - X(1, 0) * Y[0]) * unit};
}

}  // namespace limpid::detail
