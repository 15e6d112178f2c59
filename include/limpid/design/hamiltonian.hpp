// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/balance.hpp>
#include <limpid/design/state_space.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace limpid::detail {

/// Frequencies >= 0, ascending, at which a singular value of G(i omega) has a given level.
template <Real Scalar>
struct Crossings {
  bool known = false;  ///< no where the numbers are too large to tell
  std::vector<Scalar> frequencies;
};

/// The imaginary eigenvalues of the Hamiltonian matrix of a level above the gain at infinity,
///
///     [[A - B R^-1 D' C, -g B R^-1 B'], [g C' S^-1 C, -A' + C' D R^-1 B']],   R = D'D - g^2 I,  S = D D' - g^2 I
///
/// those within the rounding of an eigenvalue that is not multiple.
template <Real Scalar>
[[nodiscard]] Crossings<Scalar> level_crossings(const StateSpace<Scalar>& G, const Scalar& level) {
  using std::abs;
  using Matrix = DynamicMatrix<Scalar>;
  const Eigen::Index n = G.order(), m = G.inputs(), p = G.outputs();
  if (n == 0 || G.B.isZero(Scalar{0}) || G.C.isZero(Scalar{0})) return {true, {}};  // the gain is that of D
  // with R and S divided by g^2
  const Matrix D = G.D / level;
  const Eigen::PartialPivLU<Matrix> R(Matrix(D.transpose() * D - Matrix::Identity(m, m)));
  const Eigen::PartialPivLU<Matrix> S(Matrix(D * D.transpose() - Matrix::Identity(p, p)));
  const Matrix by_B = R.solve(G.B.transpose()), by_C = S.solve(G.C);
  const Matrix F = G.A - by_B.transpose() * D.transpose() * G.C / level;
  const Matrix H = blocks<Scalar>(F, -G.B * by_B / level, G.C.transpose() * by_C / level, -F.transpose());
  const auto eigenvalues = eigenvalues_of<Scalar>(H);
  if (eigenvalues.empty()) return {};
  const Scalar rounding =
      Scalar(static_cast<int>(128 * n)) * std::numeric_limits<Scalar>::epsilon() * largest_row(balanced<Scalar>(H));
  Crossings<Scalar> crossings{true, {}};
  for (const auto& s : eigenvalues) {
    if (abs(s.real()) <= rounding && s.imag() >= Scalar{0}) crossings.frequencies.push_back(s.imag());
  }
  std::sort(crossings.frequencies.begin(), crossings.frequencies.end());
  return crossings;
}

/// G(1/p), of a stable G: the same gains, those at infinity at zero.
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> inverted_frequency(const StateSpace<Scalar>& G) {
  using Matrix = DynamicMatrix<Scalar>;
  if (G.order() == 0) return G;
  const Eigen::PartialPivLU<Matrix> A(G.A);
  const Matrix B = A.solve(G.B), I = Matrix::Identity(G.order(), G.order());
  const Matrix inverse = A.solve(I);
  return {inverse, B, Matrix(-G.C * inverse), Matrix(G.D - G.C * B)};
}

/// The continuous system with the same gains as a stable discrete one, z = (1 + s)/(1 - s).
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> bilinear(const StateSpace<Scalar>& G) {
  using Matrix = DynamicMatrix<Scalar>;
  StateSpace<Scalar> result{G.A, G.B, G.C, G.D};
  if (G.order() == 0) return result;
  const Matrix I = Matrix::Identity(G.order(), G.order());
  const Eigen::PartialPivLU<Matrix> sum(Matrix(G.A + I));  // regular: no pole at z = -1
  const Matrix B = sum.solve(G.B), inverse = sum.solve(I);
  result.A = sum.solve(Matrix(G.A - I));
  result.B = B * Scalar{2};
  result.C = G.C * inverse;
  result.D = G.D - G.C * B;
  return result;
}

/// The frequency of a discrete system, rad/s, for that of its bilinear image.
template <Real Scalar>
[[nodiscard]] Scalar discrete_frequency(const Scalar& omega, const Scalar& period) {
  using std::acos, std::atan;
  const Scalar half_turn = acos(Scalar{-1});
  return (is_finite(omega) ? Scalar(Scalar{2} * atan(omega)) : half_turn) / period;
}

}  // namespace limpid::detail
