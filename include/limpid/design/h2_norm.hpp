// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/design/lyapunov.hpp>
#include <limpid/design/norm_verdict.hpp>
#include <limpid/design/state_space.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace limpid {

/// ||G||_2
template <Real Scalar = double>
struct H2Norm {
  Scalar norm{0};  ///< infinite unless the verdict is `finite`; never NaN
  Scalar squared{
      0};  ///< the energy itself, which the paper calls J; zero or infinite where it leaves the scalar's range
  NormVerdict verdict = NormVerdict::undecided;
};

namespace detail {

template <Real Scalar>
[[nodiscard]] H2Norm<Scalar> no_h2_norm(NormVerdict verdict) {
  return {infinity_of<Scalar>(), infinity_of<Scalar>(), verdict};
}

/// sqrt(trace C X C') of balanced states, B and C in units of their largest entry: no square over- or underflows.
template <Real Scalar>
[[nodiscard]] Scalar norm_of_states(const StateSpace<Scalar>& G) {
  using std::sqrt;
  using Matrix = DynamicMatrix<Scalar>;
  if (G.order() == 0 || G.B.isZero(Scalar{0}) || G.C.isZero(Scalar{0})) return Scalar{0};
  const Scalar by_B = G.B.cwiseAbs().maxCoeff(), by_C = G.C.cwiseAbs().maxCoeff();
  const Matrix B = G.B / by_B, C = G.C / by_C;
  const Matrix X = LyapunovSolver<Scalar>(G.A, G.is_discrete()).solve(Matrix(B * B.transpose()));
  const Scalar squared = Matrix(C * X).cwiseProduct(C).sum();
  return squared < Scalar{0} ? Scalar{0} : Scalar(sqrt(squared) * by_B * by_C);  // below zero: a zero, rounded
}

/// sqrt(trace D D')
template <Real Scalar>
[[nodiscard]] Scalar norm_of_through(const StateSpace<Scalar>& G) {
  const Scalar unit = G.D.cwiseAbs().maxCoeff();
  return unit > Scalar{0} ? Scalar(unit * DynamicMatrix<Scalar>(G.D / unit).norm()) : Scalar{0};
}

}  // namespace detail

/// The norm that the paper's index (11) is the square of, by a Lyapunov equation:
///
///     ||G||_2^2 = (1/2 pi) int trace G(i w)* G(i w) dw = trace C X C',    A X + X A' + B B' = 0
///
/// and in discrete time the sum of the squares of the impulse response, trace (C X C' + D D'), A X A' - X + B B' = 0.
/// Infinite with the verdict where it is not stable, or continuous with D != 0. Off line: 20 us for six states.
/// @throws std::invalid_argument  where the system is refused or has more states than `lyapunov` takes
template <Real Scalar>
[[nodiscard]] H2Norm<Scalar> h2_norm(const StateSpace<Scalar>& system) {
  using std::sqrt;
  if (!is_stable(system)) {
    const bool known = is_finite(stability_excess(system));
    return detail::no_h2_norm<Scalar>(known ? NormVerdict::unstable : NormVerdict::undecided);
  }
  if (!system.is_discrete() && !system.D.isZero(Scalar{0})) return detail::no_h2_norm<Scalar>(NormVerdict::unbounded);
  const StateSpace<Scalar> G = detail::balanced_states(system);
  const Scalar states = detail::norm_of_states(G), through = detail::norm_of_through(G);
  const Scalar larger = std::max<Scalar>(states, through), part = std::min<Scalar>(states, through) / larger;
  const Scalar norm = larger > Scalar{0} ? Scalar(larger * sqrt(Scalar{1} + part * part)) : states;
  if (!is_finite(norm)) return detail::no_h2_norm<Scalar>(NormVerdict::undecided);
  return {norm, norm * norm, NormVerdict::finite};
}

}  // namespace limpid
