// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/design/printed_theorem5.hpp>
#include <limpid/design/reduced_theorem.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace limpid {

/// How a disturbance enters the bound's inequality.
enum class DisturbanceEntry {
  printed,        ///< B L Delta as any vector of the plane: gamma I in (4.31)
  through_input,  ///< as the force L Delta that it is: gamma B there; as linear, and never worse
};

/// What the prediction error comes to, in the sense of L2 from rest: ||e|| <= factor ||disturbance||, e in m and m/s
/// mixed as the thesis measures it. (4.32) and (4.52) hold in this sense only, not at each instant.
///
/// The factors are those of the best P, Q, R, S, M: found, and proved, by a semidefinite program.
template <Real Scalar = double>
struct ErrorBound {
  Verdict verdict = Verdict::undecided;                          ///< feasible where a bound is proved
  Scalar by_sampling = std::numeric_limits<Scalar>::infinity();  ///< of ||Delta_T||: (4.32)
  Scalar by_force = std::numeric_limits<Scalar>::infinity();     ///< of ||Delta_theta||, per N
  Scalar least_by_sampling{0};                                   ///< no choice of P, Q, R, S, M proves less than this

  /// Both together, eq. (4.52) with the factor 2 that its cross term needs: ||a + b||^2 <= 2 ||a||^2 + 2 ||b||^2.
  [[nodiscard]] Scalar together(const Scalar& Delta_T, const Scalar& Delta_theta) const {
    using std::sqrt;
    const Scalar a = by_sampling * Delta_T, b = by_force * Delta_theta;
    return sqrt(Scalar{2} * (a * a + b * b));
  }
};

namespace detail {

/// ||L|| from entries >= 0, without their squares' underflow.
template <Real Scalar>
[[nodiscard]] Scalar length_of(const Scalar& L1, const Scalar& L2) {
  using std::sqrt;
  const Scalar larger = std::max<Scalar>(L1, L2), ratio = std::min<Scalar>(L1, L2) / larger;
  return larger > Scalar{0} ? Scalar(larger * sqrt(Scalar{1} + ratio * ratio)) : Scalar{0};
}

/// (4.35) with P, Q, R, N, M_1 themselves, not barred: L is given, so that this is linear too, and S can be asked for.
///
///     minimise 1/gamma   such that   Xi + T_d N R^-1 N' + gamma (M C)(M C)' < 0,   S = I
///
/// gamma lambda_min(S) is all that counts, and a pure scale is free: S = I is the normalisation. N is at its optimum,
/// N_1 = -R/T_d, N_2 = R/T_d, N_3 = 0. In the scaled coordinates, and divided by d^2, S = I reads diag(1/d^2, 1); the
/// column C of a vector D^-1 (1/d) I reads diag(1, 1/d) for 1/gamma itself, that of a force B' for m^2 d^2/gamma.
template <Real Scalar>
class BoundProblem {
 public:
  using Expression = LmiExpression<Scalar>;

  BoundProblem(const PredictorDesign<Scalar>& design, const Scalar& d, DisturbanceEntry entry)
      : m_{design.tool.mass}, d_{d}, entry_{entry} {
    const Ball<Scalar> one(Scalar{1}), zero(Scalar{0}), D(d);
    Eigen::Matrix<Ball<Scalar>, 2, 2> S, C;
    Eigen::Matrix<Ball<Scalar>, 2, 1> B;
    S << one / (D * D), zero, zero, one;
    B << zero, one;
    C << one, zero, zero, one / D;
    S_ = S;
    column_ = entry == DisturbanceEntry::printed ? Expression(C) : Expression(B);
  }

  Lmi<Scalar> lmi{};
  Expression P = lmi.symmetric("P", 2);  ///< at the box's centre

  /// @param rate  sum +-|rho_i'|_max dP/drho_i
  void require(const ErrorDynamics<Scalar>& e, const Expression& P_here, const Expression& rate) {
    const Expression MA = M1_ * e.A, MBL = M1_ * (Expression(e.B) * e.L), MC = transpose(M1_ * column_);
    const Expression Xi = reduced_block<Scalar>(e, P_here, Q_, R_, MA, MBL, transpose(M1_), S_ + rate);
    const Expression row = block<Scalar>({{MC, e.a2 * MC, e.a3 * MC}});
    lmi.require(symmetric_block<Scalar>({{Xi}, {row, -(g_ * identity<Scalar>(column_.columns()))}}) < 0);
    lmi.require(P_here > 0);
  }

  /// @param gains  L where it is largest
  [[nodiscard]] ErrorBound<Scalar> solve(std::span<const Row2<Ball<Scalar>>> gains) {
    lmi.require(Q_ > 0);
    lmi.require(R_ > 0);
    lmi.minimise(g_);
    const LmiResult<Scalar> result = lmi.solve();
    ErrorBound<Scalar> bound;
    bound.verdict = result.verdict;
    if (!result.feasible()) return bound;
    using std::sqrt;
    const auto exact = [](const Ball<Scalar>& L) { return L.radius() == Scalar{0}; };
    const auto most = [&](const Ball<Scalar>& L) { return exact(L) ? abs(L).centre() : L.magnitude(); };
    const auto least = [&](const Ball<Scalar>& L) { return exact(L) ? abs(L).centre() : L.least_magnitude(); };
    Scalar longest{0}, shortest{0};
    for (const auto& L : gains) {
      longest = std::max<Scalar>(longest, length_of<Scalar>(most(L.first), most(L.second)));
      shortest = std::max<Scalar>(shortest, length_of<Scalar>(least(L.first), least(L.second)));
    }
    const bool printed = entry_ == DisturbanceEntry::printed;
    const auto root = [&](const Scalar& g) { return printed ? Scalar(sqrt(g) / m_) : Scalar(sqrt(g) / (m_ * d_)); };
    const Scalar up = Scalar{1} + Scalar{32} * std::numeric_limits<Scalar>::epsilon();
    bound.by_force = root(result.objective) * up;
    bound.by_sampling = bound.by_force * longest * up;
    bound.least_by_sampling = root(std::max<Scalar>(Scalar{0}, result.objective_bound)) * shortest / (up * up);
    return bound;
  }

 private:
  Expression Q_ = lmi.symmetric("Q", 2), R_ = lmi.symmetric("R", 2);
  Expression M1_ = lmi.full("M1", 2, 2), g_ = lmi.scalar("1/gamma");
  Expression S_ = zero<Scalar>(2, 2), column_ = zero<Scalar>(2, 0);
  Scalar m_, d_;
  DisturbanceEntry entry_;
};

}  // namespace detail

/// Bound (4.32) of the error by what sampling adds, for Theorem 3 with a given gain at each tissue, with common
/// variables. `printed` is (4.32) with the best variables; `through_input` the tighter one. Off line: allocates.
/// @param L  N/m, N s/m
/// @throws std::invalid_argument  where the design, a tissue or the gain cannot be used
template <Real Scalar>
[[nodiscard]] ErrorBound<Scalar> theorem3_error_bound(const PredictorDesign<Scalar>& design,
                                                      std::span<const Tissue<Scalar>> tissues, const Gain<Scalar>& L,
                                                      DisturbanceEntry entry = DisturbanceEntry::through_input) {
  const Scalar d = detail::common_frequency(design, tissues);
  expect(is_finite(L), "theorem3_error_bound: L", "finite", L);
  detail::BoundProblem<Scalar> problem(design, d, entry);
  for (const Tissue<Scalar>& tissue : tissues) {
    problem.require({design, tissue, L, Coordinates::scaled, d}, problem.P, zero<Scalar>(2, 2));
  }
  const detail::Row2<Ball<Scalar>> exact{L[0], L[1]};
  return problem.solve({&exact, 1});
}
template <Real Scalar>
[[nodiscard]] ErrorBound<Scalar> theorem3_error_bound(const PredictorDesign<Scalar>& design,
                                                      const Tissue<Scalar>& tissue, const Gain<Scalar>& L,
                                                      DisturbanceEntry entry = DisturbanceEntry::through_input) {
  return theorem3_error_bound<Scalar>(design, std::span<const Tissue<Scalar>>(&tissue, 1), L, entry);
}

/// Bound (4.52), for Theorem 5 with a given gain over the box and the rates; `together` adds its two parts.
template <Real Scalar>
[[nodiscard]] ErrorBound<Scalar> theorem5_error_bound(const PredictorDesign<Scalar>& design,
                                                      const TissueBox<Scalar>& box, const TissueRates<Scalar>& rates,
                                                      const AffineGain<Scalar>& L,
                                                      DisturbanceEntry entry = DisturbanceEntry::through_input) {
  using Expression = LmiExpression<Scalar>;
  detail::check_theorem5(design, box, rates);
  const Scalar d = detail::time_scale(design, box.centre());
  detail::BoundProblem<Scalar> problem(design, d, entry);
  const auto slope = [&](const char* name, const Scalar& lower, const Scalar& upper) {
    return lower < upper ? problem.lmi.symmetric(name, 2) : zero<Scalar>(2, 2);
  };
  const Expression P1 = slope("P1", box.lower.stiffness, box.upper.stiffness);
  const Expression P2 = slope("P2", box.lower.damping, box.upper.damping);
  const auto rate1 = detail::rate_by_half_width(rates.stiffness, box.lower.stiffness, box.upper.stiffness, d);
  const auto rate2 = detail::rate_by_half_width(rates.damping, box.lower.damping, box.upper.damping, d);
  std::vector<detail::Row2<Ball<Scalar>>> gains;
  for (const BoxCorner& at : box_corners) {
    const Tissue<Scalar> rho = tissue_at(box, at);
    expect(is_finite(L(rho)), "theorem5_error_bound: L", "finite", L(rho));
    gains.push_back(detail::enclosed_gain(L, rho));
    const ErrorDynamics<Scalar> e(design, rho, gains.back(), Coordinates::scaled, d);
    const Expression P = problem.P + Expression(at.stiffness) * P1 + Expression(at.damping) * P2;
    for (const BoxCorner& sign : box_corners) {
      problem.require(e, P, Expression(sign.stiffness) * (rate1 * P1) + Expression(sign.damping) * (rate2 * P2));
    }
  }
  return problem.solve(gains);
}

/// |Delta_T| of (4.28), entry by entry: what a hold over T_d adds to the errors of position (m) and velocity (m/s).
/// @param velocity, velocity_hat          |x_e'|_max and |x^_e'|_max, m/s, >= 0
/// @param acceleration, acceleration_hat  |x_e''|_max and |x^_e''|_max, m/s^2, >= 0
/// @throws std::invalid_argument  where an argument is negative or not finite
template <Real Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, 2, 1> sampling_error_bound(const Scalar& T_d, const Scalar& velocity,
                                                               const Scalar& velocity_hat, const Scalar& acceleration,
                                                               const Scalar& acceleration_hat) {
  expect(is_finite(T_d) && T_d > Scalar{0}, "sampling_error_bound: T_d", "finite and > 0", T_d);
  for (const Scalar* most : {&velocity, &velocity_hat, &acceleration, &acceleration_hat}) {
    expect(is_finite(*most) && *most >= Scalar{0}, "sampling_error_bound: velocity, acceleration", "finite and >= 0",
           *most);
  }
  return {T_d * (velocity + velocity_hat), T_d * (acceleration + acceleration_hat)};
}

}  // namespace limpid
