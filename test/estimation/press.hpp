// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/estimation/projection_rls.hpp>

#include <cmath>

namespace limpid::test {

using Linear = ProjectionRLS<2>;  // stiffness and damping
using Pair = Linear::Theta;

inline Linear::Settings linear_model() {
  return {.lower = Pair(200, 20), .upper = Pair(2000, 40), .initial = Pair(1100, 30), .initial_gain = Pair(1e9, 8e6)};
}

inline Linear::Vector force(double F) { return Linear::Vector::Constant(F); }

/// Presses for `seconds` at 1 kHz on theta, with x = 5 mm (1 - cos(pi t)).
template <int N, typename Scalar>
void press(ProjectionRLS<N, 1, Scalar>& rls, const Eigen::Array<Scalar, 1, N>& theta, double seconds) {
  for (int k = 0; k < int(seconds * 1000); ++k) {
    const double t = k * 1e-3;
    Eigen::Array<Scalar, 1, N> phi = Eigen::Array<Scalar, 1, N>::Ones();
    phi(0) = Scalar(0.005 * (1 - std::cos(M_PI * t)));
    if constexpr (N > 1) phi(1) = Scalar(0.005 * M_PI * std::sin(M_PI * t));
    (void)rls.update(Scalar(0.001), phi, Eigen::Array<Scalar, 1, 1>::Constant((phi * theta).sum()));
  }
}

template <typename Rls>
void idle(Rls& rls, int milliseconds) {
  for (int k = 0; k < milliseconds; ++k) {
    (void)rls.update(typename Rls::Vector::Scalar(0.001), Rls::Regressor::Zero(), Rls::Vector::Zero());
  }
}

}  // namespace limpid::test
