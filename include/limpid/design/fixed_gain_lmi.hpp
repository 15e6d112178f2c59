// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/margin_problem.hpp>
#include <limpid/design/reduced_lmi.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace limpid {

/// One `T` for each of `tissues` tissues, or as many as wanted where that is Eigen::Dynamic.
template <typename T, int tissues>
using PerTissue = std::conditional_t<tissues == Eigen::Dynamic, std::vector<T>,
                                     std::array<T, tissues == Eigen::Dynamic ? 1 : static_cast<std::size_t>(tissues)>>;

namespace detail {

/// With how many tissues a problem is solved: known to the compiler only where it fills lanes; all others share one
/// solver.
template <Real Scalar, int tissues>
inline constexpr int points_solved = fills_lanes<Scalar> ? tissues : Eigen::Dynamic;

template <typename List>
void resize(List& list, std::size_t size) {
  if constexpr (requires { list.resize(size); }) list.resize(size);
}

/// Multipliers of the blocks that P, Q and R > 0 meet when L is fixed.
template <Real Scalar, int tissues>
struct FixedGainMultipliers {
  Square<Scalar, 4> Z_multiplier{};
  PerTissue<Square<Scalar, 4>, tissues> Z_dynamics{};
};

/// The two blocks of reduced_lmi.hpp for L fixed: the first once, the second for each tissue with common P, Q, R.
///
/// Between the tissues too, as the second is concave in A: A' R A with R > 0 is taken off.
template <Real Scalar, int tissues>
class FixedGainLmi {
 public:
  static constexpr bool dynamic = tissues == Eigen::Dynamic || !fills_lanes<Scalar>;
  static constexpr int width = dynamic ? 1 : tissues == 1 ? 2 : 4;
  static constexpr int packs = dynamic ? Eigen::Dynamic : (tissues + 1 + width - 1) / width;
  using Margin = MarginProblem<Scalar, 9, 4, packs, 2, (3 + width - 1) / width, width>;
  using Lyapunov = LyapunovMatrices<Scalar>;
  using Multipliers = FixedGainMultipliers<Scalar, tissues>;

  /// Of what a design, tissues and a gain are in `Given`, which Scalar holds exactly.
  template <Real Given>
  FixedGainLmi(const PredictorDesign<Given>& design, std::span<const Tissue<Given>> given, const Gain<Given>& L,
               const Given& time_scale) {
    const auto exact = widen<Scalar>(design);
    const Gain<Scalar> gain = L.template cast<Scalar>();
    const Scalar d(time_scale);
    ball_.s = scale_design<Ball<Scalar>>(exact, d);
    ball_.L = scale_gain<Ball<Scalar>>(exact, gain, d);
    s_ = {ball_.s.T.centre(), ball_.s.a2.centre(), ball_.s.a3.centre()};
    L_ = centre_of_each(ball_.L);
    resize(ball_.A, given.size());
    resize(A_, given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
      const Tissue<Scalar> tissue{Scalar(given[i].stiffness), Scalar(given[i].damping)};
      ball_.A[i] = scale_dynamics<Ball<Scalar>>(exact, tissue, d);
      A_[i] = centre_of_each(ball_.A[i]);
    }
  }

  /// Whether P, Q, R > 0 and both kinds of block, rounding accounted for.
  [[nodiscard, gnu::noinline]] bool proves_feasible(const Lyapunov& candidate) const {
    const auto m = convert<Ball<Scalar>>(candidate);
    if (!proves_positive(candidate)) return false;
    if (!proves_positive(block_of_multiplier(m, ball_.s))) return false;
    for (const auto& A : ball_.A) {
      if (!proves_positive(block_of_dynamics(m, ball_.s, A, ball_.L))) return false;
    }
    return true;
  }

  /// Whether Z > 0 and what it leaves for P, Q, R is positive definite too: then there are none.
  [[nodiscard, gnu::noinline]] bool proves_infeasible(const Multipliers& candidate) const {
    if (candidate.Z_dynamics.size() != A_.size()) return false;
    if (!proves_positive(candidate.Z_multiplier)) return false;
    Square<Ball<Scalar>, 6> Z = spread_multiplier(convert<Ball<Scalar>>(candidate.Z_multiplier), ball_.s);
    for (std::size_t i = 0; i < A_.size(); ++i) {
      if (!proves_positive(candidate.Z_dynamics[i])) return false;
      add(Z, spread_multiplier(convert<Ball<Scalar>>(candidate.Z_dynamics[i]), ball_.A[i], ball_.L));
    }
    return proves_positive(multipliers_left(Z, ball_.s));
  }

  /// Until either is proved: the status says which.
  SdpStatus solve(Lyapunov& lyapunov, Multipliers& multipliers, int& iterations) const {
    Margin margin(A_.size() + 1, 3);
    PerTissue<Square<Scalar, 4>, tissues == Eigen::Dynamic ? Eigen::Dynamic : tissues + 1> blocks;
    resize(blocks, A_.size() + 1);
    for (int i = 0; i < 9; ++i) {
      const Lyapunov unit = lyapunov_of(Margin::Vector::Unit(i));
      blocks[0] = block_of_multiplier(unit, s_);
      for (std::size_t k = 0; k < A_.size(); ++k) blocks[k + 1] = block_of_dynamics(unit, s_, A_[k], L_);
      const std::array<Square<Scalar, 2>, 3> positive{square(unit.P), square(unit.Q), square(unit.R)};
      margin.add_variable(blocks, positive);
    }
    return margin.solve(
        start(), 60,
        [&](const typename Margin::Vector& x, const Scalar& lambda, bool maybe_feasible, bool maybe_infeasible,
            const auto& Z) {
          if (maybe_feasible) {
            lyapunov = lyapunov_of(x);
            if (proves_feasible(lyapunov)) return SdpStatus::primal_certificate;
          }
          if (maybe_infeasible) {
            resize(multipliers.Z_dynamics, A_.size());
            multipliers.Z_multiplier = Margin::multiplier(Z, 0, blocks.size(), lambda);
            for (std::size_t k = 0; k < A_.size(); ++k) {
              multipliers.Z_dynamics[k] = Margin::multiplier(Z, k + 1, blocks.size(), lambda);
            }
            if (proves_infeasible(multipliers)) return SdpStatus::dual_certificate;
          }
          return SdpStatus::optimal;
        },
        iterations);
  }

 private:
  template <typename S>
  struct Data {
    ScaledDesign<S> s;
    PerTissue<Matrix2<S>, tissues> A;
    Row2<S> L;
  };

  [[nodiscard]] static Lyapunov lyapunov_of(const typename Margin::Vector& x) {
    return {symmetric(x[0], x[1], x[2]), symmetric(x[3], x[4], x[5]), symmetric(x[6], x[7], x[8])};
  }
  [[nodiscard]] static typename Margin::Vector start() {
    typename Margin::Vector x;
    x << 1, 0, 1, 1, 0, 1, 1, 0, 1;
    return x;
  }
  Data<Ball<Scalar>> ball_{};
  ScaledDesign<Scalar> s_{};
  PerTissue<Matrix2<Scalar>, tissues> A_{};
  Row2<Scalar> L_{};
};

}  // namespace detail

}  // namespace limpid
