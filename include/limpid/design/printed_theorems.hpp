// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/ball.hpp>
#include <limpid/design/design_point.hpp>
#include <limpid/design/lmi.hpp>
#include <limpid/design/scaled_point.hpp>

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace limpid {

/// In which an inequality of the predictor is written. Feasibility is the same in both; solvers are not: in raw units
/// margins are 1e-6 to 1e-9.
enum class Coordinates {
  scaled,  ///< e = diag(1, d) e', time in 1/d, the input such that |B'| = 1; d = sqrt((k_t + k_e)/m_t) at the centre
  raw,     ///< m, m/s, s
};

/// The error dynamics (4.16) at one tissue and what the theorems multiply it with, each entry with its rounding.
template <Real Scalar = double>
struct ErrorDynamics {
  using Number = Ball<Scalar>;
  template <int rows, int columns>
  using Matrix = Eigen::Matrix<Number, rows, columns>;

  Matrix<2, 2> A;
  Matrix<2, 1> B;
  Matrix<1, 2> L;  ///< zero where L is unknown
  Number T_d, a2, a3;

  /// @param gain  as it is, exact
  /// @param d     of the scaled coordinates, 1/s; any number > 0 will do, so that its own rounding does not matter
  ErrorDynamics(const PredictorDesign<Scalar>& design, const Tissue<Scalar>& tissue, const Gain<Scalar>& gain,
                Coordinates coordinates, const Scalar& d)
      : ErrorDynamics(design, tissue, detail::Row2<Number>{gain[0], gain[1]}, coordinates, d) {}

  /// @param gain  within these
  ErrorDynamics(const PredictorDesign<Scalar>& design, const Tissue<Scalar>& tissue, const detail::Row2<Number>& gain,
                Coordinates coordinates, const Scalar& d) {
    const Number one(1);
    const bool scaled = coordinates == Coordinates::scaled;
    const Scalar unit = scaled ? d : Scalar{1};  // A' and T_d' are A and T_d where d = 1
    const auto A_ = detail::scale_dynamics<Number>(design, tissue, unit);
    const auto L_ = scaled ? detail::scale_gain(design, gain, unit) : gain;
    const auto s = detail::scale_design<Number>(design, unit);
    A << A_.a11, A_.a12, A_.a21, A_.a22;
    B << Number(0), scaled ? one : one / Number(design.tool.mass);
    L << L_.first, L_.second;
    T_d = s.T;
    a2 = s.a2;
    a3 = s.a3;
  }
};

/// Theorem 2, 3 or 5 as printed, unreduced: for comparison, for margins and for bounds. To decide feasibility alone,
/// theorem3.hpp and theorem5.hpp have smaller problems with the same verdict.
///
/// Off line: allocates.
template <Real Scalar = double>
struct PrintedTheorem {
  using Expression = LmiExpression<Scalar>;

  Lmi<Scalar> lmi;
  Expression P, Q, R, S, gamma;  ///< barred; S and gamma are 0 in Theorem 2
  Expression N1, N2, N3, X, Y;   ///< Y of the first tissue; L X' where L is given
  Coordinates coordinates = Coordinates::scaled;
  Scalar d{1};     ///< 1/s
  Scalar mass{1};  ///< m_t, kg

  /// L = Y X'^-1, in raw units.
  [[nodiscard]] Gain<Scalar> gain(const LmiResult<Scalar>& result) const { return gain(result, Y); }
  [[nodiscard]] Gain<Scalar> gain(const LmiResult<Scalar>& result, const Expression& of) const {
    const bool scaled = coordinates == Coordinates::scaled;
    return detail::gain_of<Scalar>(result[X], result[of], scaled ? mass : Scalar{1}, scaled ? d : Scalar{1});
  }
};

namespace detail {

/// The variables that the theorems share.
template <Real Scalar>
[[nodiscard]] PrintedTheorem<Scalar> printed_variables(bool with_disturbance) {
  Lmi<Scalar> lmi;
  const auto P = lmi.symmetric("P", 2), Q = lmi.symmetric("Q", 2), R = lmi.symmetric("R", 2);
  const auto S = with_disturbance ? lmi.symmetric("S", 2) : zero<Scalar>(2, 2);
  const auto gamma = with_disturbance ? lmi.scalar("gamma") : zero<Scalar>(1, 1);
  const auto N1 = lmi.full("N1", 2, 2), N2 = lmi.full("N2", 2, 2), N3 = lmi.full("N3", 2, 2);
  const auto X = lmi.full("X", 2, 2);
  return {std::move(lmi), P, Q, R, S, gamma, N1, N2, N3, X, zero<Scalar>(1, 2)};
}

/// The left side of (4.17), (4.31) and (4.51).
/// @param P, Y   at this tissue
/// @param rate   sum +-|rho_i'|_max dP/drho_i of (4.51)
/// @param column of the disturbance in (4.31): I; B for the tighter bound; empty for Theorem 2
template <Real Scalar>
[[nodiscard]] LmiExpression<Scalar> printed_matrix(const PrintedTheorem<Scalar>& v, const ErrorDynamics<Scalar>& e,
                                                   const LmiExpression<Scalar>& P, const LmiExpression<Scalar>& Y,
                                                   const LmiExpression<Scalar>& rate,
                                                   const LmiExpression<Scalar>& column) {
  using Expression = LmiExpression<Scalar>;
  const auto& [A, B, L, T_d, a2, a3] = e;
  const Expression AX = A * transpose(v.X), BY = B * Y;
  const Expression Phi11 = v.Q + v.N1 + transpose(v.N1) - AX - transpose(AX) + v.S + rate;
  const Expression Phi21 = v.N2 - a2 * AX - transpose(v.N1) - transpose(BY);
  const Expression Phi22 = -v.Q - v.N2 - transpose(v.N2) - a2 * BY - a2 * transpose(BY);
  const Expression Phi31 = P + v.N3 - a3 * AX + v.X;
  const Expression Phi32 = -v.N3 - a3 * BY + a2 * v.X;
  const Expression Phi33 = a3 * transpose(v.X) + a3 * v.X + T_d * v.R;
  const Expression N1T = T_d * transpose(v.N1), N2T = T_d * transpose(v.N2), N3T = T_d * transpose(v.N3);
  if (column.columns() == 0) {
    return symmetric_block<Scalar>({{Phi11}, {Phi21, Phi22}, {Phi31, Phi32, Phi33}, {N1T, N2T, N3T, -(T_d * v.R)}});
  }
  const Expression row = v.gamma * transpose(column);
  return symmetric_block<Scalar>({{Phi11},
                                  {Phi21, Phi22},
                                  {Phi31, Phi32, Phi33},
                                  {N1T, N2T, N3T, -(T_d * v.R)},
                                  {row, a2 * row, a3 * row, 0, -(v.gamma * identity<Scalar>(column.columns()))}});
}

template <Real Scalar>
void require_positive(PrintedTheorem<Scalar>& theorem) {
  theorem.lmi.require(theorem.P > 0);
  theorem.lmi.require(theorem.Q > 0);
  theorem.lmi.require(theorem.R > 0);
  if (theorem.S.is_zero()) return;
  theorem.lmi.require(theorem.S > 0);
  theorem.lmi.require(theorem.gamma > 0);
}

/// d at the centre of the tissues.
/// @throws std::invalid_argument  where there is none, or the design or a tissue cannot be used
template <Real Scalar>
[[nodiscard]] Scalar common_frequency(const PredictorDesign<Scalar>& design, std::span<const Tissue<Scalar>> tissues) {
  expect(!tissues.empty(), "printed theorem: tissues", "at least one", tissues.size());
  Tissue<Scalar> centre{};
  for (const Tissue<Scalar>& tissue : tissues) {
    design.check(tissue);
    centre.stiffness += tissue.stiffness / Scalar(tissues.size());
  }
  return time_scale(design, centre);
}

/// (4.17) or (4.31) at each tissue, with common variables; one L for all, free where none is given.
template <Real Scalar>
[[nodiscard]] PrintedTheorem<Scalar> printed_constant_gain(const PredictorDesign<Scalar>& design,
                                                           std::span<const Tissue<Scalar>> tissues,
                                                           const std::optional<Gain<Scalar>>& L,
                                                           Coordinates coordinates, bool with_disturbance) {
  if (L) expect(is_finite(*L), "printed theorem: L", "finite", *L);
  auto theorem = printed_variables<Scalar>(with_disturbance);
  theorem.coordinates = coordinates;
  theorem.d = common_frequency(design, tissues);
  theorem.mass = design.tool.mass;
  if (!L) theorem.Y = theorem.lmi.full("Y", 1, 2);
  const auto column = with_disturbance ? identity<Scalar>(2) : zero<Scalar>(2, 0);
  for (const Tissue<Scalar>& tissue : tissues) {
    const ErrorDynamics<Scalar> e(design, tissue, L.value_or(Gain<Scalar>::Zero()), coordinates, theorem.d);
    if (L) theorem.Y = e.L * transpose(theorem.X);
    theorem.lmi.require(printed_matrix(theorem, e, theorem.P, theorem.Y, zero<Scalar>(2, 2), column) < 0);
  }
  require_positive(theorem);
  return theorem;
}

}  // namespace detail

/// Theorem 2, (4.17), at each of the tissues with common variables.
/// @param L  N/m, N s/m; none: to be found
/// @throws std::invalid_argument  where the design or a tissue cannot be used
template <Real Scalar>
[[nodiscard]] PrintedTheorem<Scalar> printed_theorem2(const PredictorDesign<Scalar>& design,
                                                      std::span<const Tissue<Scalar>> tissues,
                                                      const std::optional<Gain<Scalar>>& L = std::nullopt,
                                                      Coordinates coordinates = Coordinates::scaled) {
  return detail::printed_constant_gain(design, tissues, L, coordinates, false);
}

/// Theorem 3, (4.31), likewise; gamma is a variable.
template <Real Scalar>
[[nodiscard]] PrintedTheorem<Scalar> printed_theorem3(const PredictorDesign<Scalar>& design,
                                                      std::span<const Tissue<Scalar>> tissues,
                                                      const std::optional<Gain<Scalar>>& L = std::nullopt,
                                                      Coordinates coordinates = Coordinates::scaled) {
  return detail::printed_constant_gain(design, tissues, L, coordinates, true);
}

}  // namespace limpid
