// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/complex_matrix.hpp>
#include <limpid/design/state_space.hpp>

#include <Eigen/Core>

#include <cmath>
#include <complex>

namespace limpid {

/// C (s I - A)^-1 B + D; not finite where s is a pole. Off line.
template <Real Scalar>
[[nodiscard]] ComplexMatrix<Scalar> response_at(const StateSpace<Scalar>& G, const std::complex<Scalar>& s) {
  using Complex = std::complex<Scalar>;
  ComplexMatrix<Scalar> value = G.D.template cast<Complex>();
  if (G.order() == 0) return value;
  ComplexMatrix<Scalar> pencil = -G.A.template cast<Complex>();
  pencil.diagonal().array() += s;
  return value + detail::product<Scalar>(G.C, detail::solved<Scalar>(pencil, G.B.template cast<Complex>()));
}

/// The point at which a system answers to a sine of `omega`: i omega, or exp(i omega T).
template <Real Scalar>
[[nodiscard]] std::complex<Scalar> frequency_point(const Scalar& omega, const Scalar& period) {
  using std::cos, std::sin;
  if (!(period > Scalar{0})) return {Scalar{0}, omega};
  return {cos(omega * period), sin(omega * period)};
}

/// G(i omega) or G(exp(i omega T)); omega in rad/s. Off line.
/// @throws std::invalid_argument  where the system is refused or omega is not finite
template <Real Scalar>
[[nodiscard]] ComplexMatrix<Scalar> frequency_response(const StateSpace<Scalar>& G, const Scalar& omega) {
  G.check();
  expect(is_finite(omega), "frequency_response: omega", "finite", omega);
  return response_at(G, frequency_point(omega, G.period));
}

}  // namespace limpid
