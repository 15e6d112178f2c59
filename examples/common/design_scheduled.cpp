// SPDX-License-Identifier: MIT
// Theorem 5 as `design_gain` asks it.
#include "design_scheduled.hpp"
#include "design_instances.hpp"

#include <limpid/design/largest_box.hpp>
#include <limpid/design/predictor_bounds.hpp>
#include <limpid/design/predictor_margin.hpp>
#include <limpid/design/spline_design.hpp>
#include <limpid/design/theorem5.hpp>

#include <string>

namespace limpid::examples {

namespace {

TissueBox<> box_of(const DesignTask& task) {
  return task.over_box ? task.box : TissueBox<>{task.environment, task.environment};
}

template <typename Found>
InequalityAnswer answer_of(const Found& found) {
  return {
      .verdict = found.verdict, .certified = found.verdict != Verdict::undecided, .reason = std::string(found.reason)};
}

// Over the box, with the largest margin or the first one found; at one point the thesis's step 1 of section 4.4.1.
ScheduledGainDesign<> find_affine(const DesignTask& task) {
  if (!task.over_box) return design_theorem5_at_point(task.design, task.environment);
  ScheduledGainDesign<> found = design_theorem5(task.design, task.box, task.rates);
  if (found.verdict != Verdict::feasible || task.criterion != DesignCriterion::margin) return found;
  auto theorem = printed_theorem5(task.design, task.box, task.rates);
  auto& centre = theorem.at_centre;
  centre.lmi.normalise(trace(centre.P) + trace(centre.Q) + trace(centre.R) + trace(centre.S) + centre.gamma == 1);
  centre.lmi.maximise_margin();
  const LmiResult<> best = centre.lmi.solve();
  if (best.feasible()) found.gain = theorem.gain(best);
  return found;
}

// B-splines in the place of an affine dependence, where that is not enough.
InequalityAnswer find_spline(const DesignTask& task) {
  const auto knots = KnotGrid<>::uniform(task.box, task.knots, task.knots);
  const SplineDesign<> found = design_spline(task.design, knots, task.rates);
  InequalityAnswer answer = answer_of(found);
  if (found.verdict != Verdict::feasible) return answer;
  for (int node = 0; node < knots.nodes(); ++node) {
    answer.at_knots.push_back({knots.node(node), found.gain.L[static_cast<std::size_t>(node)]});
  }
  return answer;
}

}  // namespace

InequalityAnswer verify_scheduled_gain(const DesignTask& task, const AffineGain<>& gain) {
  InequalityAnswer answer = answer_of(verify_theorem5(task.design, box_of(task), task.rates, gain));
  take_margin(theorem5_margin(task.design, box_of(task), task.rates, {gain}), answer);
  return answer;
}

InequalityAnswer find_scheduled_gain(const DesignTask& task) {
  if (task.knots > 0) return find_spline(task);
  const auto found = find_affine(task);
  if (found.verdict != Verdict::feasible) {
    InequalityAnswer answer = answer_of(found);
    take_margin(theorem5_margin(task.design, box_of(task), task.rates), answer);
    return answer;
  }
  InequalityAnswer answer = verify_scheduled_gain(task, found.gain);
  answer.gain = found.gain;
  take_bound(theorem5_error_bound(task.design, box_of(task), task.rates, found.gain), answer);
  return answer;
}

LargestBox<> largest_scheduled_box(const PredictorDesign<>& design, const TissueBox<>& whole,
                                   const TissueRates<>& rates, const std::optional<AffineGain<>>& L) {
  return largest_box(whole, [&](const TissueBox<>& box) {
    return L ? verify_theorem5(design, box, rates, *L).verdict : design_theorem5(design, box, rates).verdict;
  });
}

}  // namespace limpid::examples
