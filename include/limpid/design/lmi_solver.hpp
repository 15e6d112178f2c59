// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/design/lmi_result.hpp>
#include <limpid/design/scaled_lmi.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace limpid {

/// Which solution of an Lmi is asked for.
enum class LmiGoal {
  any,        ///< the first one with a certificate
  margin,     ///< that of the largest margin
  objective,  ///< that of the largest objective
};

template <Real Scalar = double>
struct LmiSettings {
  int iterations = 100;  ///< of one run of the solver, > 0

  /// @throws std::invalid_argument  where iterations are none
  void check() const { expect(iterations > 0, "Lmi: iterations", "> 0", iterations); }
};

namespace detail {

/// Finds what LmiResult reports; accepts nothing without its certificate.
template <Real Scalar>
class LmiSolver {
 public:
  using Problem = LmiProblem<Scalar>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Result = LmiResult<Scalar>;

  LmiSolver(const Problem& problem, LmiGoal goal, const LmiSettings<Scalar>& settings)
      : problem_{problem}, goal_{goal}, settings_{.iterations = settings.iterations} {}

  [[nodiscard]] Result solve() {
    if (goal_ == LmiGoal::margin) return largest_margin();
    Result result = any();
    if (goal_ == LmiGoal::objective && result.feasible()) largest_objective(result);
    return result;
  }

 private:
  using Method = PrimalDualMethod<DynamicSdp<Scalar>>;
  using Point = typename Method::Point;

  // max t with x_0 F_0 + F(x) >= t I, x_0 >= t, and a trace of n: bounded, and both sides known to have an interior.
  // t > 0 solves the inequalities with x / x_0; a dual value y < 0 makes Z - y I > 0 a proof that nothing does.
  Result any() {
    const bool without_equation = problem_.homogeneous();
    Result result = any(!without_equation);
    // The equation of a homogeneous problem only scales, but for its sign.
    if (without_equation && problem_.has_equation && result.verdict == Verdict::undecided && wrong_side_) {
      const int before = result.iterations;
      result = any(true);
      result.iterations += before;
    }
    return result;
  }

  Result any(bool homogenise) {
    Result result;
    const ScaledLmi<Scalar> scaled(problem_, homogenise);
    if (!scaled.has_trace()) return without_trace(scaled, std::move(result));
    const DynamicSdp<Scalar> sdp = scaled.feasibility();
    Point at = scaled.feasibility_start(sdp);
    Method method(sdp, at);
    const SdpStatus status = method.run(settings_, [&](const Point& point) {
      if (scaled.margin(point) > Scalar{0} && accept_solution(scaled, point, result))
        return SdpStatus::primal_certificate;
      if (point.y[0] < Scalar{0} && accept_proof(scaled, point, result)) return SdpStatus::dual_certificate;
      return SdpStatus::optimal;
    });
    result.iterations = method.iterations();
    result.reason = describe(status);
    if (result.verdict == Verdict::undecided && !wrong_side_) try_fewer_blocks(scaled.proof(at), result);
    if (result.verdict == Verdict::undecided) {
      result.reason += wrong_side_ ? "; the equation is met by multiples below 0 only"
                                   : "; neither side has a certificate: the largest margin is 0 to rounding";
    }
    return result;
  }

  // Where some blocks contradict each other and others have no part in it, the largest margin is 0, at the boundary of
  // the former: their multipliers stay, those of the others vanish. Without the others the margin is below 0.
  void try_fewer_blocks(LmiMultipliers<Scalar> last, Result& result) const {
    Scalar largest{0};
    for (const auto& Z : last.Z) largest = std::max<Scalar>(largest, Z.trace());
    Problem fewer = problem_;
    fewer.blocks.clear();
    std::vector<std::size_t> kept;
    for (std::size_t j = 0; j < last.Z.size(); ++j) {
      if (!(last.Z[j].trace() > largest / Scalar{1000})) continue;
      fewer.blocks.push_back(problem_.blocks[j]);
      kept.push_back(j);
    }
    if (kept.empty() || kept.size() == last.Z.size()) return;
    Result part = LmiSolver(fewer, LmiGoal::any, {.iterations = settings_.iterations}).solve();
    result.iterations += part.iterations;
    if (part.verdict != Verdict::infeasible) return;
    for (auto& Z : last.Z) Z.setZero();
    for (std::size_t k = 0; k < kept.size(); ++k) last.Z[kept[k]] = part.multipliers.Z[k];
    last.y = part.multipliers.y;
    if (!certifies_infeasible(problem_, last)) return;
    result.verdict = Verdict::infeasible;
    result.multipliers = std::move(last);
    result.reason = "dual certificate reached for a part of the inequalities";
  }

  // No combination has a trace: Z = I is the proof.
  Result without_trace(const ScaledLmi<Scalar>& scaled, Result result) const {
    result.multipliers = scaled.unit_multipliers();
    if (certifies_infeasible(problem_, result.multipliers)) {
      result.verdict = Verdict::infeasible;
      result.reason = "every combination has trace 0";
    } else {
      result.multipliers = {};
      result.reason = "the traces of all coefficients are 0 to rounding only";
    }
    return result;
  }

  bool accept_solution(const ScaledLmi<Scalar>& scaled, const Point& point, Result& result) {
    auto [x, margin] = scaled.solution(point);
    if (!scaled.homogenised() && problem_.has_equation) {
      const Scalar scale = scale_to_plane(x);
      wrong_side_ = !(scale > Scalar{0});
      if (wrong_side_ || !is_finite(scale)) return false;
      x *= scale;
      margin *= scale;
    }
    if (problem_.has_equation) project(x);
    for (const Scalar& t : {margin / Scalar{2}, Scalar{0}}) {
      if (!certifies_feasible(problem_, x, t)) continue;
      result.verdict = Verdict::feasible;
      result.unknowns = x;
      result.margin = t;
      return true;
    }
    return false;
  }

  // Onto the plane c'x = d, which the solver may not have reached yet.
  void project(Vector& x) const {
    Scalar residual{0}, squares{0};
    for (const auto& term : problem_.equation) {
      const bool constant = term.unknown == LmiExpression<Scalar>::constant;
      residual += term.factor.centre() * (constant ? Scalar{1} : x[term.unknown]);
      if (!constant) squares += term.factor.centre() * term.factor.centre();
    }
    for (const auto& term : problem_.equation) {
      if (term.unknown != LmiExpression<Scalar>::constant) x[term.unknown] -= term.factor.centre() * residual / squares;
    }
  }

  // By how much x has to be multiplied to have c'x = d.
  [[nodiscard]] Scalar scale_to_plane(const Vector& x) const {
    Scalar product{0}, d{0};
    for (const auto& term : problem_.equation) {
      if (term.unknown == LmiExpression<Scalar>::constant) {
        d -= term.factor.centre();
      } else {
        product += term.factor.centre() * x[term.unknown];
      }
    }
    return d / product;
  }

  bool accept_proof(const ScaledLmi<Scalar>& scaled, const Point& point, Result& result) const {
    LmiMultipliers<Scalar> dual = scaled.proof(point);
    if (!certifies_infeasible(problem_, dual)) return false;
    result.verdict = Verdict::infeasible;
    result.multipliers = std::move(dual);
    return true;
  }

  // max t with F(x) - t I >= 0 and the equation.
  Result largest_margin() {
    Result result;
    const Problem with_margin = margin_problem();
    const ScaledLmi<Scalar> scaled(with_margin, false);
    const DynamicSdp<Scalar> sdp = scaled.optimisation();
    Point at = scaled.margin_start(sdp);
    Scalar best = -std::numeric_limits<Scalar>::infinity();
    improve(with_margin, scaled, sdp, at, result, [&](const Vector& x) {
      const Scalar t = x[problem_.unknowns];
      if (!(t > best) || !certifies_feasible<Scalar>(problem_, x.head(problem_.unknowns), t)) return best;
      result.unknowns = x.head(problem_.unknowns);
      return best = t;
    });
    result.margin = best;
    result.margin_bound = std::exchange(result.objective_bound, std::numeric_limits<Scalar>::quiet_NaN());
    if (best >= Scalar{0}) {
      result.verdict = Verdict::feasible;
      result.multipliers = {};
    } else if (result.margin_bound <= Scalar{0} && certifies_infeasible(problem_, result.multipliers)) {
      result.verdict = Verdict::infeasible;
      result.unknowns = {};
    } else {
      result.reason += "; the largest margin is between " + text(best) + " and " + text(result.margin_bound);
    }
    return result;
  }

  [[nodiscard]] Problem margin_problem() const {
    Problem with_margin = problem_;
    const int t = with_margin.unknowns++;
    for (auto& block : with_margin.blocks) {
      for (int i = 0; i < block.size; ++i) block.terms.push_back({t, i, i, Ball<Scalar>(Scalar{-1})});
    }
    with_margin.objective = {{t, 0, 0, Ball<Scalar>(Scalar{1})}};
    return with_margin;
  }

  // From a solution on.
  void largest_objective(Result& result) {
    const ScaledLmi<Scalar> scaled(problem_, false);
    const DynamicSdp<Scalar> sdp = scaled.optimisation();
    Point at = scaled.start(sdp, result.unknowns, false);
    result.objective = evaluate_objective(result.unknowns);
    improve(problem_, scaled, sdp, at, result, [&](const Vector& x) {
      const Scalar value = evaluate_objective(x);
      if (!(value > result.objective) || !certifies_feasible<Scalar>(problem_, x, Scalar{0})) return result.objective;
      result.unknowns = x;
      result.margin = Scalar{0};
      return result.objective = value;
    });
    result.multipliers = {};
  }

  // Runs until the certified value and the certified bound are as close as the solver gets them.
  template <typename Accept>
  void improve(const Problem& problem, const ScaledLmi<Scalar>& scaled, const DynamicSdp<Scalar>& sdp, Point& at,
               Result& result, Accept&& accept) {
    using std::abs, std::sqrt;
    result.objective_bound = std::numeric_limits<Scalar>::infinity();
    Method method(sdp, at);
    const SdpStatus status = method.run(settings_, [&](const Point& point) {
      if (method.gap() > close_enough()) return SdpStatus::optimal;
      const Scalar value = accept(scaled.values(point));
      LmiMultipliers<Scalar> dual = scaled.multipliers(point);
      const Scalar bound = certified_upper_bound(problem, dual);
      if (bound < result.objective_bound) {
        result.objective_bound = bound;
        result.multipliers = std::move(dual);
      }
      const Scalar size = Scalar{1} + abs(value);
      return result.objective_bound - value < sharp() * size ? SdpStatus::primal_certificate : SdpStatus::optimal;
    });
    result.iterations += method.iterations();
    result.reason = describe(status);
  }

  [[nodiscard]] Scalar evaluate_objective(const Vector& x) const {
    Scalar value{0};
    for (const auto& term : problem_.objective) {
      value += term.factor.centre() * (term.unknown == LmiExpression<Scalar>::constant ? Scalar{1} : x[term.unknown]);
    }
    return value;
  }

  static Scalar close_enough() { return Scalar{1} / Scalar{1000}; }
  static Scalar sharp() { return std::numeric_limits<Scalar>::epsilon() * Scalar{65536}; }
  static std::string text(const Scalar& value) {
    std::ostringstream out;
    out << value;
    return out.str();
  }

  const Problem& problem_;
  LmiGoal goal_;
  SdpSettings<Scalar> settings_;
  bool wrong_side_ = false;
};

template <Real Scalar>
[[nodiscard]] LmiResult<Scalar> solve_lmi(const LmiProblem<Scalar>& problem, LmiGoal goal,
                                          const LmiSettings<Scalar>& settings) {
  return LmiSolver<Scalar>(problem, goal, settings).solve();
}

}  // namespace detail
}  // namespace limpid
