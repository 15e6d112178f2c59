// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/design/exact_hold_index.hpp>
#include <limpid/design/exact_hold_loop.hpp>
#include <limpid/design/h2_norm.hpp>
#include <limpid/design/hinf_norm.hpp>
#include <limpid/design/norm_verdict.hpp>
#include <limpid/design/transparency_model.hpp>
#include <limpid/design/transparency_problem.hpp>

namespace limpid {

/// J of (11): the square of the norm, in units of (m/(N s))^2 rad/s.
template <Real Scalar = double>
struct TransparencyIndex {
  Scalar J{0};      ///< infinite unless the verdict is `finite`; never NaN
  Scalar error{0};  ///< of the quadrature with the exact hold: what the last halving changed, and a bound of the tail;
                    ///< 0 for a rational hold, where J is exact but for rounding
  NormVerdict verdict = NormVerdict::undecided;
};

/// Whether the nominal loop of Fig. 3, device, hold and feedback, is stable by more than rounding: by its poles with a
/// rational hold, by the argument principle along a verified path with the exact one. Sampling is not in this model;
/// see sampled_wall.hpp for the loop as it runs. No where the numbers leave the scalar's range.
/// @throws std::invalid_argument  where an argument is refused
template <Real Scalar>
[[nodiscard]] bool is_nominally_stable(const TransparencyProblem<Scalar>& problem, const WallFeedback<Scalar>& C) {
  detail::check(problem, C);
  if (problem.hold == HoldModel::exact) return detail::ExactHoldLoop<Scalar>(problem, C).is_stable();
  const StateSpace<Scalar> Y = transmitted_admittance_system(problem, C);
  return is_finite(Y.A) && is_finite(Y.B) && is_stable(Y);
}

namespace detail {

/// Whether the admittances of wall and device have entries in the scalar's range.
template <Real Scalar>
[[nodiscard]] bool is_index_in_range(const TransparencyProblem<Scalar>& problem) {
  const auto& [m, b] = problem.plant;
  const auto& [K, B] = problem.wall;
  const StateSpace<Scalar>& w1 = problem.weight;
  const bool device = is_finite(Scalar(Scalar{1} / m)) && is_finite(Scalar(b / m)) && is_finite(Scalar(K / m));
  if (B > Scalar{0}) return device && is_finite(Scalar(Scalar{1} / B)) && is_finite(Scalar(K / B / B));
  return device && is_finite(DynamicMatrix<Scalar>(w1.C * w1.A / K)) &&
         is_finite(DynamicMatrix<Scalar>(w1.C * w1.B / K));
}

// With A X + X A' + B B' = 0 and A' Y + Y A + C' C = 0: dJ = 2 trace Y dA X, and A holds each gain once.
template <Real Scalar>
[[nodiscard]] IndexSlopes<Scalar> rational_index(const TransparencyProblem<Scalar>& problem,
                                                 const WallFeedback<Scalar>& C) {
  using Matrix = DynamicMatrix<Scalar>;
  const RationalLoop<Scalar> loop = rational_loop(problem, C);
  const StateSpace<Scalar> E = weighted_error(problem.weight, problem.wall, transmitted(problem, loop));
  const DynamicVector<Scalar> d = balancing<Scalar>(E.A), inverse = d.cwiseInverse();
  const Matrix A = inverse.asDiagonal() * E.A * d.asDiagonal();
  const Matrix B = inverse.asDiagonal() * E.B, output = E.C * d.asDiagonal();
  const LyapunovSolver<Scalar> forward(A, false), backward(Matrix(A.transpose()), false);
  IndexSlopes<Scalar> result{infinity_of<Scalar>(), Scalar{0}, Scalar{0}, infinity_of<Scalar>()};
  const Matrix X = forward.solve(Matrix(B * B.transpose()));
  const Matrix Y = backward.solve(Matrix(output.transpose() * output));
  const Scalar J = Matrix(output * X).cwiseProduct(output).sum();
  if (!is_finite(J) || J < Scalar{0}) return result;  // below zero: nothing but rounding is left
  const Eigen::Index first = E.order() - loop.A.rows(), driven = first + loop.driven;
  const auto slope = [&](Eigen::Index by) -> Scalar {
    const Eigen::Index i = first + by;
    return Scalar{2} * loop.by_gain * d[i] / d[driven] * X.row(i).dot(Y.col(driven));
  };
  return {J, slope(RationalLoop<Scalar>::v), slope(RationalLoop<Scalar>::x), Scalar{0}, NormVerdict::finite};
}

template <Real Scalar>
[[nodiscard]] IndexSlopes<Scalar> index_slopes(const TransparencyProblem<Scalar>& problem,
                                               const WallFeedback<Scalar>& C) {
  const Scalar infinity = infinity_of<Scalar>();
  if (!is_index_in_range(problem)) return {infinity, Scalar{0}, Scalar{0}, infinity, NormVerdict::undecided};
  if (!is_nominally_stable(problem, C) || !is_stable(problem.weight)) {
    return {infinity, Scalar{0}, Scalar{0}, infinity, NormVerdict::unstable};
  }
  if (!is_index_bounded(problem)) return {infinity, Scalar{0}, Scalar{0}, infinity, NormVerdict::unbounded};
  if (problem.hold == HoldModel::exact) return ExactHoldIndex<Scalar>(problem, C).run();
  return rational_index(problem, C);
}

}  // namespace detail

/// J, (11): exact by the Lyapunov equation for the holds A and B, by quadrature for C. Infinite with the verdict where
/// the loop or the weight is not stable, and where w1 Y_v does not go to zero at high frequency.
///
/// Off line: 0.1 ms (A, B), 10 to 100 ms (C).
/// @throws std::invalid_argument  where an argument is refused
template <Real Scalar>
[[nodiscard]] TransparencyIndex<Scalar> transparency_index(const TransparencyProblem<Scalar>& problem,
                                                           const WallFeedback<Scalar>& C) {
  detail::check(problem, C);
  const auto slopes = detail::index_slopes(problem, C);
  return {slopes.J, slopes.error, slopes.verdict};
}

/// ||L||_inf, (17), and its peak: by hinf_norm for the holds A and B; for C the highest of a sweep, polished, and an
/// upper bound that a finite number of cells prove for the whole axis, 4e-9 above where their number allows. Infinite
/// with the verdict where the nominal loop is not stable.
///
/// Off line: some ms (A, B), some 10 ms (C).
/// @throws std::invalid_argument  where an argument is refused
template <Real Scalar>
[[nodiscard]] HinfNorm<Scalar> uncertainty_norm(const TransparencyProblem<Scalar>& problem,
                                                const WallFeedback<Scalar>& C) {
  if (!is_nominally_stable(problem, C)) return detail::no_hinf_norm<Scalar>(NormVerdict::unstable);
  if (problem.hold == HoldModel::exact) return detail::ExactHoldLoop<Scalar>(problem, C).norm();
  return hinf_norm(uncertainty_system(problem, C));
}

}  // namespace limpid
