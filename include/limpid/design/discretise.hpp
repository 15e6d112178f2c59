// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/held_step.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/balance.hpp>
#include <limpid/design/state_space.hpp>

#include <Eigen/Core>

namespace limpid {

/// How a continuous system becomes a discrete one.
enum class Discretisation {
  zero_order_hold,  ///< exact at the samples for an input that is held between them
  tustin,           ///< s = (2/T)(z - 1)/(z + 1)
  backward_euler,   ///< s = (z - 1)/(T z)
};

/// The discrete system of a continuous one. Off line.
/// @throws std::invalid_argument  where the system is refused or discrete, the period is not positive and finite, or
///                                I - A T/2 (Tustin) or I - A T (backward Euler) is singular
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> discretise(const StateSpace<Scalar>& G, const Scalar& period, Discretisation method) {
  using Matrix = detail::DynamicMatrix<Scalar>;
  G.check();
  expect(!G.is_discrete(), "discretise: G", "continuous", G.period);
  expect(is_finite(period) && period > Scalar{0}, "discretise: period", "finite and > 0", period);
  const Eigen::Index n = G.order();
  if (n == 0) return {G.A, G.B, G.C, G.D, period};
  if (method == Discretisation::zero_order_hold) {
    // In balanced states: x = diag(d) w
    const detail::DynamicVector<Scalar> d = detail::balancing<Scalar>(G.A), inverse = d.cwiseInverse();
    const auto step = held_step(Matrix(inverse.asDiagonal() * G.A * d.asDiagonal()), period);
    const Matrix Psi = d.asDiagonal() * step.Psi * inverse.asDiagonal();
    return {Matrix(d.asDiagonal() * step.Phi * inverse.asDiagonal()), Matrix(Psi * G.B), G.C, G.D, period};
  }
  const bool tustin = method == Discretisation::tustin;
  const Scalar h = tustin ? Scalar(period / Scalar{2}) : period;
  const Matrix I = Matrix::Identity(n, n);
  const Matrix R = detail::inverse_of<Scalar>(I - G.A * h);
  expect(R.size() > 0, "discretise: A", tustin ? "without an eigenvalue 2/T" : "without an eigenvalue 1/T", G.A);
  const Matrix B = R * G.B * period;
  if (tustin) return {Matrix(R * (I + G.A * h)), B, Matrix(G.C * R), Matrix(G.D + G.C * B / Scalar{2}), period};
  return {R, B, Matrix(G.C * R), Matrix(G.D + G.C * B), period};
}

}  // namespace limpid
