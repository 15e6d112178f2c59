// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/lmi.hpp>
#include <limpid/design/predictor_bounds.hpp>
#include <limpid/design/predictor_margin.hpp>
#include <limpid/design/reduced_theorem.hpp>
#include <limpid/design/sampled_stability.hpp>
#include <limpid/design/theorem3.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace limpid {

/// By what one gain is chosen among those that Theorem 3 allows; the thesis takes what its solver's path ends at.
enum class GainCriterion {
  largest_margin,           ///< of Theorem 3, as predictor_margin.hpp defines it: a semidefinite program with L free
  smallest_bound,           ///< of the error per force of disturbance, `ErrorBound::by_force`: one too
  smallest_sampled_radius,  ///< of the sampled system: a search in the plane of L
};

[[nodiscard]] constexpr std::string_view describe(GainCriterion criterion) noexcept {
  switch (criterion) {
    case GainCriterion::largest_margin:
      return "largest margin";
    case GainCriterion::smallest_bound:
      return "smallest bound";
    default:
      return "smallest sampled radius";
  }
}

/// The best gain by a criterion. `value` is within 1e-6 of the best one, relatively, for the two programs, 1e-3 for the
/// search; there is no start to depend on.
template <Real Scalar = double>
struct GainChoice {
  Verdict verdict = Verdict::undecided;  ///< feasible: Theorem 3 is proved for `gain` as it stands, rounded
  Gain<Scalar> gain = Gain<Scalar>::Zero();
  Scalar value = std::numeric_limits<Scalar>::quiet_NaN();  ///< margin, bound (by N) or radius
  std::string reason{};
};

namespace detail {

/// Minimises the L2 gain from a force to the error, over L too. Barred, with S = I, X S X' is not linear, but its Schur
/// complement is:
///
///     maximise gamma   such that   [F + gamma (M C)(M C)'  X S^(1/2); ., -I] < 0
///
/// with F of `reduced_matrix`, M C = (B; a2 B; a3 B). Coordinates and units as in BoundProblem: S = diag(1/d^2, 1).
template <Real Scalar>
[[nodiscard]] LmiResult<Scalar> smallest_bound(const PredictorDesign<Scalar>& design,
                                               std::span<const Tissue<Scalar>> tissues, Gain<Scalar>& gain) {
  using Expression = LmiExpression<Scalar>;
  const Scalar d = common_frequency(design, tissues);
  Lmi<Scalar> lmi;
  const auto P = lmi.symmetric("P", 2), Q = lmi.symmetric("Q", 2), R = lmi.symmetric("R", 2);
  const auto X = lmi.full("X", 2, 2), Y = lmi.full("Y", 1, 2), gamma = lmi.scalar("gamma");
  const Ball<Scalar> one(Scalar{1}), none(Scalar{0});
  Eigen::Matrix<Ball<Scalar>, 2, 2> root_S;
  root_S << one / Ball<Scalar>(d), none, none, one;
  for (const Tissue<Scalar>& tissue : tissues) {
    const ErrorDynamics<Scalar> e(design, tissue, Gain<Scalar>::Zero(), Coordinates::scaled, d);
    const Expression B(e.B), BB = B * transpose(B);
    const Expression input =
        symmetric_block<Scalar>({{BB}, {e.a2 * BB, e.a2 * e.a2 * BB}, {e.a3 * BB, e.a2 * e.a3 * BB, e.a3 * e.a3 * BB}});
    const Expression F = reduced_matrix(e, P, Q, R, X, Y, zero<Scalar>(2, 2)) + gamma * input;
    const Expression row = block<Scalar>({{Expression(root_S) * transpose(X), zero<Scalar>(2, 4)}});
    lmi.require(symmetric_block<Scalar>({{F}, {row, -identity<Scalar>(2)}}) < 0);
  }
  for (const Expression* positive : {&P, &Q, &R, &gamma}) lmi.require(*positive > 0);
  lmi.maximise(gamma);
  LmiResult<Scalar> result = lmi.solve();
  if (result.feasible()) gain = gain_of<Scalar>(result[X], result[Y], design.tool.mass, d);
  return result;
}

/// The gain that puts all three roots of the sampled system's polynomial, z^3 - tr z^2 + p_1(L) z + p_0(L), on tr/3: no
/// gain of one tissue has a smaller radius, as the roots' sum is given. Zero where the delay is not the period's.
template <Real Scalar>
[[nodiscard]] Gain<Scalar> triple_root_gain(const SampledStability<Scalar>& sampled, const Tissue<Scalar>& tissue,
                                            const Scalar& unit1, const Scalar& unit2) {
  const auto at = [&](const Scalar& L1, const Scalar& L2) { return sampled.polynomial(tissue, {L1, L2}); };
  const auto p = at(Scalar{0}, Scalar{0}), by1 = at(unit1, Scalar{0}), by2 = at(Scalar{0}, unit2);
  if (p.size() != 4) return Gain<Scalar>::Zero();
  const Scalar root = -p[2] / Scalar{3};
  Eigen::Matrix<Scalar, 2, 2> slope;
  slope << by1[1] - p[1], by2[1] - p[1], by1[0] - p[0], by2[0] - p[0];
  const Eigen::Matrix<Scalar, 2, 1> missing(Scalar{3} * root * root - p[1], -root * root * root - p[0]);
  const Scalar determinant = slope(0, 0) * slope(1, 1) - slope(0, 1) * slope(1, 0);
  return {unit1 * (slope(1, 1) * missing[0] - slope(0, 1) * missing[1]) / determinant,
          unit2 * (slope(0, 0) * missing[1] - slope(1, 0) * missing[0]) / determinant};
}

/// The smallest worst radius over the tissues, among the gains that Theorem 3 certifies: grids of L', each about the
/// best point of the one before and finer by a constant.
template <Real Scalar>
class RadiusSearch {
 public:
  RadiusSearch(const PredictorDesign<Scalar>& design, std::span<const Tissue<Scalar>> tissues)
      : design_{design},
        tissues_{tissues},
        d_{common_frequency(design, tissues)},
        sampled_{{.tool = design.tool, .period = design.T_d, .delay = design.T_d}} {}

  [[nodiscard]] GainChoice<Scalar> run(std::span<const Gain<Scalar>> candidates) {
    for (const Gain<Scalar>& L : candidates) consider(L);
    // Beyond |L1'| = 1 the predictor's spring would be overcome: nothing there is certified.
    const Scalar per_velocity = design_.tool.mass * d_;
    const Gain<Scalar> unit(per_velocity * d_, per_velocity);  // L = L' m d^2 D^-1
    if (tissues_.size() == 1) consider(triple_root_gain<Scalar>(sampled_, tissues_.front(), unit[0], unit[1]));
    Gain<Scalar> centre = Gain<Scalar>::Zero();
    for (Scalar reach{2}; reach > Scalar{1} / Scalar{1'000'000}; reach *= Scalar{3} / Scalar{8}) {
      for (int i = -half; i <= half; ++i) {
        for (int j = -half; j <= half; ++j) {
          const Eigen::Matrix<Scalar, 1, 2> offset(reach * Scalar(i) / Scalar(half), reach * Scalar(j) / Scalar(half));
          consider(unscale_gain<Scalar>({centre[0] + offset[0], centre[1] + offset[1]}, design_.tool.mass, d_));
        }
      }
      if (best_.verdict != Verdict::feasible) continue;
      const auto [L1, L2] = scale_gain<Scalar>(design_, best_.gain, d_);
      centre << L1, L2;
    }
    return best_;
  }

 private:
  static constexpr int half = 12;

  void consider(const Gain<Scalar>& L) {
    Scalar worst{0};
    for (const Tissue<Scalar>& tissue : tissues_) worst = std::max<Scalar>(worst, sampled_.radius(tissue, L));
    if (worst >= best_radius_ || !is_finite(worst) || !certified(L)) return;
    best_radius_ = worst;
    best_ = {Verdict::feasible, L, worst, "certified"};
  }
  [[nodiscard]] bool certified(const Gain<Scalar>& L) const {
    if (tissues_.size() == 1) return verify_theorem3(design_, tissues_.front(), L).verdict == Verdict::feasible;
    return verify_theorem3(design_, tissues_, L).verdict == Verdict::feasible;
  }

  const PredictorDesign<Scalar>& design_;
  std::span<const Tissue<Scalar>> tissues_;
  Scalar d_;
  SampledStability<Scalar> sampled_;
  Scalar best_radius_ = std::numeric_limits<Scalar>::infinity();
  GainChoice<Scalar> best_{Verdict::undecided, Gain<Scalar>::Zero(), std::numeric_limits<Scalar>::quiet_NaN(),
                           "no gain on the grid is certified"};
};

template <Real Scalar>
[[nodiscard]] GainChoice<Scalar> by_largest_margin(const PredictorDesign<Scalar>& design,
                                                   std::span<const Tissue<Scalar>> tissues) {
  auto theorem = printed_theorem3(design, tissues);
  ask_for_margin(theorem);
  const LmiResult<Scalar> result = theorem.lmi.solve();
  GainChoice<Scalar> choice{result.verdict, {}, result.margin, result.reason};
  if (result.feasible()) choice.gain = theorem.gain(result);
  return choice;
}

}  // namespace detail

/// Chooses L for all of the tissues at once, with common variables, by Theorem 3. Off line: allocates; some ms by the
/// first two criteria, some 100 ms by the third.
/// @throws std::invalid_argument  where there is no tissue, or the design or one of them cannot be used
template <Real Scalar>
[[nodiscard]] GainChoice<Scalar> choose_gain(const PredictorDesign<Scalar>& design,
                                             std::span<const Tissue<Scalar>> tissues, GainCriterion criterion) {
  GainChoice<Scalar> choice = detail::by_largest_margin(design, tissues);
  if (choice.verdict != Verdict::feasible) return choice;
  if (criterion == GainCriterion::smallest_sampled_radius) {
    return detail::RadiusSearch<Scalar>(design, tissues).run(std::array{choice.gain});
  }
  if (criterion == GainCriterion::smallest_bound) {
    (void)detail::smallest_bound(design, tissues, choice.gain);
    const ErrorBound<Scalar> bound = theorem3_error_bound(design, tissues, choice.gain);
    choice = {bound.verdict, choice.gain, bound.by_force, "least bound"};
  }
  // The gain was rounded: prove it again.
  const auto proof = verify_theorem3(design, tissues, choice.gain);
  choice.verdict = proof.verdict;
  choice.reason = proof.reason;
  return choice;
}
template <Real Scalar>
[[nodiscard]] GainChoice<Scalar> choose_gain(const PredictorDesign<Scalar>& design, const Tissue<Scalar>& tissue,
                                             GainCriterion criterion) {
  return choose_gain<Scalar>(design, std::span<const Tissue<Scalar>>(&tissue, 1), criterion);
}

}  // namespace limpid
