// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/design/state_space.hpp>
#include <limpid/design/transparency_problem.hpp>

#include <Eigen/Core>

#include <cmath>

namespace limpid {
namespace detail {

/// The loop of Fig. 3 with a rational hold, from the operator's force: states v, x and those of the hold, F_d first.
///
///     m v' = F_h - F_d - b v,   x' = v,   F_d = ZOH(B_c v + K_c x)
template <Real Scalar>
struct RationalLoop {
  static constexpr Eigen::Index v = 0, x = 1, F_d = 2;

  DynamicMatrix<Scalar> A;
  Eigen::Index driven;  ///< the state of the hold that B_c v + K_c x drives
  Scalar by_gain;       ///< with this factor
};

template <Real Scalar>
[[nodiscard]] RationalLoop<Scalar> rational_loop(const TransparencyProblem<Scalar>& problem,
                                                 const WallFeedback<Scalar>& C) {
  using std::acos, std::sqrt;
  using Loop = RationalLoop<Scalar>;
  const bool second_order = problem.hold == HoldModel::second_order;
  const auto& [m, b] = problem.plant;
  const Eigen::Index n = second_order ? 4 : 3;
  Loop loop{zeros<Scalar>(n, n), n - 1, Scalar{0}};
  DynamicMatrix<Scalar>& A = loop.A;
  A(Loop::v, Loop::v) = -b / m;
  A(Loop::v, Loop::F_d) = Scalar{-1} / m;
  A(Loop::x, Loop::v) = Scalar{1};
  if (second_order) {
    const Scalar w_n = acos(Scalar{-1}) / problem.period;
    A(2, 3) = w_n;  // the second state is F_d'/w_n
    A(3, 2) = -w_n;
    A(3, 3) = -sqrt(Scalar{2}) * w_n;
    loop.by_gain = w_n;
  } else {
    loop.by_gain = Scalar{2} / problem.period;
    A(2, 2) = -loop.by_gain;
  }
  A(loop.driven, Loop::v) += loop.by_gain * C.B_c;
  A(loop.driven, Loop::x) += loop.by_gain * C.K_c;
  return loop;
}

/// w1 s/(K + B s), of the states of w1 and of p = f/(K + B s), f = w1 F_h:
///
///     B p' = f - K p,   y = p' = (f - K p)/B
///
/// With B = 0 it is f'/K.
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> weighted_wall(const StateSpace<Scalar>& w1, const VirtualWall<Scalar>& wall) {
  using Matrix = DynamicMatrix<Scalar>;
  const auto& [K, B] = wall;
  if (B > Scalar{0}) {
    const Scalar rate = K / B;
    return series(w1, StateSpace<Scalar>{Matrix::Constant(1, 1, -rate), Matrix::Ones(1, 1),
                                         Matrix::Constant(1, 1, -rate / B), Matrix::Constant(1, 1, Scalar{1} / B)});
  }
  return {w1.A, w1.B, Matrix(w1.C * w1.A / K), Matrix(w1.C * w1.B / K)};
}

/// Whether w1 Y_v goes to zero at high frequency, without which no index is finite.
template <Real Scalar>
[[nodiscard]] bool is_index_bounded(const TransparencyProblem<Scalar>& problem) {
  const StateSpace<Scalar>& w1 = problem.weight;
  if (!w1.D.isZero(Scalar{0})) return false;
  return problem.wall.damping > Scalar{0} || w1.order() == 0 || (w1.C * w1.B)(0, 0) == Scalar{0};
}

/// w1 (Y_v - Y), given Y: states of w1, the wall and Y.
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> weighted_error(const StateSpace<Scalar>& w1, const VirtualWall<Scalar>& wall,
                                                const StateSpace<Scalar>& Y) {
  using Matrix = DynamicMatrix<Scalar>;
  const StateSpace<Scalar> felt = weighted_wall(w1, wall);
  const Eigen::Index n = felt.order(), k = Y.order();
  Matrix from_weight = zeros<Scalar>(k, n);
  from_weight.leftCols(w1.order()) = Y.B * w1.C;
  return {blocks<Scalar>(felt.A, zeros<Scalar>(n, k), from_weight, Y.A),
          blocks<Scalar>(felt.B, {n, 0}, Matrix(Y.B * w1.D), {k, 0}), blocks<Scalar>(felt.C, -Y.C, {0, n}, {0, k}),
          felt.D};
}

/// Y_t of a rational hold.
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> transmitted(const TransparencyProblem<Scalar>& problem,
                                             const RationalLoop<Scalar>& loop) {
  const Eigen::Index n = loop.A.rows();
  StateSpace<Scalar> Y{loop.A, zeros<Scalar>(n, 1), zeros<Scalar>(1, n), zeros<Scalar>(1, 1)};
  Y.B(RationalLoop<Scalar>::v, 0) = Scalar{1} / problem.plant.mass;
  Y.C(0, RationalLoop<Scalar>::v) = Scalar{1};
  return Y;
}

}  // namespace detail

/// Y_t(s), (9), of models A and B.
/// @throws std::invalid_argument  where an argument is refused, or the hold is the exact one, which is not rational
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> transmitted_admittance_system(const TransparencyProblem<Scalar>& problem,
                                                               const WallFeedback<Scalar>& C) {
  detail::check(problem, C);
  expect(problem.hold != HoldModel::exact, "transmitted_admittance_system: hold", "rational", describe(problem.hold));
  return detail::transmitted(problem, detail::rational_loop(problem, C));
}

/// L(s), (16), of models A and B: -W v = -alpha (F - F_d - b v) - beta b v.
/// @throws std::invalid_argument  as `transmitted_admittance_system`
template <Real Scalar>
[[nodiscard]] StateSpace<Scalar> uncertainty_system(const TransparencyProblem<Scalar>& problem,
                                                    const WallFeedback<Scalar>& C) {
  using Loop = detail::RationalLoop<Scalar>;
  StateSpace<Scalar> L = transmitted_admittance_system(problem, C);
  const auto& [alpha, beta] = problem.uncertainty;
  L.C(0, Loop::v) = (alpha - beta) * problem.plant.damping;
  L.C(0, Loop::F_d) = alpha;
  L.D(0, 0) = -alpha;
  return L;
}

}  // namespace limpid
