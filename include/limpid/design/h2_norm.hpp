// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/lyapunov.hpp>
#include <limpid/design/norm_verdict.hpp>
#include <limpid/design/state_space.hpp>

#include <Eigen/Core>

#include <cmath>

namespace limpid {

/// ||G||_2
template <Real Scalar = double>
struct H2Norm {
  Scalar norm{0};     ///< infinite unless the verdict is `finite`; never NaN
  Scalar squared{0};  ///< the energy itself, which the paper calls J
  NormVerdict verdict = NormVerdict::undecided;
};

namespace detail {

template <Real Scalar>
[[nodiscard]] H2Norm<Scalar> no_h2_norm(NormVerdict verdict) {
  return {infinity_of<Scalar>(), infinity_of<Scalar>(), verdict};
}

}  // namespace detail

/// The norm that the paper's index (11) is the square of, by a Lyapunov equation:
///
///     ||G||_2^2 = (1/2 pi) int trace G(i w)* G(i w) dw = trace C X C',    A X + X A' + B B' = 0
///
/// and in discrete time the sum of the squares of the impulse response, trace (C X C' + D D'), A X A' - X + B B' = 0.
/// Infinite with the verdict where it is not stable, or continuous with D != 0. Off line: 20 us for six states.
/// @throws std::invalid_argument  where the system is refused
template <Real Scalar>
[[nodiscard]] H2Norm<Scalar> h2_norm(const StateSpace<Scalar>& system) {
  using std::sqrt;
  using Matrix = detail::DynamicMatrix<Scalar>;
  if (!is_stable(system)) {
    const bool known = is_finite(stability_excess(system));
    return detail::no_h2_norm<Scalar>(known ? NormVerdict::unstable : NormVerdict::undecided);
  }
  if (!system.is_discrete() && !system.D.isZero(Scalar{0})) return detail::no_h2_norm<Scalar>(NormVerdict::unbounded);
  const StateSpace<Scalar> G = detail::balanced_states(system);
  Scalar squared = G.D.squaredNorm();
  if (G.order() > 0) {
    const detail::LyapunovSolver<Scalar> solver(G.A, G.is_discrete());
    const Matrix X = solver.solve(Matrix(G.B * G.B.transpose()));
    squared += Matrix(G.C * X).cwiseProduct(G.C).sum();
  }
  if (!is_finite(squared)) return detail::no_h2_norm<Scalar>(NormVerdict::undecided);
  if (squared < Scalar{0}) squared = Scalar{0};  // a zero, rounded
  return {sqrt(squared), squared, NormVerdict::finite};
}

}  // namespace limpid
