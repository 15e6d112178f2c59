// SPDX-License-Identifier: MIT
// Theorems 2 and 3 as `design_gain` asks them; Theorem 5: design_scheduled.cpp.
#include "design_instances.hpp"
#include "design_judge.hpp"
#include "design_scheduled.hpp"

#include <limpid/design/gain_choice.hpp>
#include <limpid/design/predictor_bounds.hpp>
#include <limpid/design/predictor_margin.hpp>
#include <limpid/design/theorem3.hpp>
#include <limpid/design/theorem3_design.hpp>

#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace limpid::examples {

namespace {

using Tissues = std::span<const limpid::Tissue<>>;

// The point, or the corners of the box: the inequality is affine between them.
std::vector<limpid::Tissue<>> tissues_of(const DesignTask& task) {
  if (!task.over_box) return {task.environment};
  std::vector<limpid::Tissue<>> corners;
  for (const BoxCorner& corner : box_corners) corners.push_back(tissue_at(task.box, corner));
  return corners;
}

template <typename Found>
InequalityAnswer answer_of(const Found& found) {
  return {
      .verdict = found.verdict, .certified = found.verdict != Verdict::undecided, .reason = std::string(found.reason)};
}

// The verdict by the reduced problem; where that leaves it open, by the printed one.
InequalityAnswer verify_constant_gain(const DesignTask& task, const Gain<>& L) {
  const std::vector<limpid::Tissue<>> tissues = tissues_of(task);
  InequalityAnswer answer = task.over_box ? answer_of(verify_theorem3(task.design, Tissues(tissues), L))
                                          : answer_of(verify_theorem3(task.design, task.environment, L));
  take_margin(task.theorem == DesignTheorem::two ? theorem2_margin(task.design, Tissues(tissues), {L})
                                                 : theorem3_margin(task.design, Tissues(tissues), {L}),
              answer);
  return answer;
}

// The gain of largest margin of (4.17).
GainChoice<> largest_margin_of_theorem2(const DesignTask& task, const Tissues& tissues) {
  auto theorem = printed_theorem2(task.design, tissues);
  theorem.lmi.normalise(trace(theorem.P) + trace(theorem.Q) + trace(theorem.R) == 1);
  theorem.lmi.maximise_margin();
  const LmiResult<> found = theorem.lmi.solve();
  return {found.verdict, found.feasible() ? theorem.gain(found) : Gain<>::Zero(), found.margin, found.reason};
}

GainChoice<> first_gain(const DesignTask& task, const Tissues& tissues) {
  if (task.over_box) {
    const auto found = design_theorem3(task.design, tissues);
    return {found.verdict, found.gain, unknown, std::string(found.reason)};
  }
  const auto found = design_theorem3(task.design, task.environment);
  return {found.verdict, found.gain, unknown, std::string(found.reason)};
}

GainChoice<> choose_constant_gain(const DesignTask& task, const Tissues& tissues) {
  switch (task.criterion) {
    case DesignCriterion::bound:
      return choose_gain(task.design, tissues, GainCriterion::smallest_bound);
    case DesignCriterion::radius:
      return choose_gain(task.design, tissues, GainCriterion::smallest_sampled_radius);
    case DesignCriterion::margin:
      if (task.theorem == DesignTheorem::two) return largest_margin_of_theorem2(task, tissues);
      return choose_gain(task.design, tissues, GainCriterion::largest_margin);
    case DesignCriterion::first:
      break;
  }
  return first_gain(task, tissues);
}

}  // namespace

double error_bound(const PredictorDesign<>& design, const limpid::Tissue<>& tissue, const Gain<>& L, bool printed) {
  const auto entry = printed ? DisturbanceEntry::printed : DisturbanceEntry::through_input;
  const ErrorBound<> bound = theorem3_error_bound(design, tissue, L, entry);
  return bound.verdict == Verdict::feasible ? bound.by_sampling : unknown;
}

InequalityAnswer ask_inequality(const DesignTask& task) {
  if (task.theorem == DesignTheorem::five) return verify_scheduled_gain(task, *task.gain);
  return verify_constant_gain(task, task.gain->L0);
}

// What was found is verified as if it had been given: the numbers that are printed are the ones that are certified.
InequalityAnswer ask_for_gain(const DesignTask& task) {
  if (task.theorem == DesignTheorem::five) return find_scheduled_gain(task);
  const std::vector<limpid::Tissue<>> tissues = tissues_of(task);
  const GainChoice<> found = choose_constant_gain(task, tissues);
  if (found.verdict != Verdict::feasible) {
    InequalityAnswer answer = answer_of(found);
    take_margin(task.theorem == DesignTheorem::two ? theorem2_margin(task.design, Tissues(tissues))
                                                   : theorem3_margin(task.design, Tissues(tissues)),
                answer);
    return answer;
  }
  InequalityAnswer answer = verify_constant_gain(task, found.gain);
  answer.gain = AffineGain<>{.L0 = found.gain};
  if (task.theorem == DesignTheorem::three) {
    take_bound(theorem3_error_bound(task.design, Tissues(tissues), found.gain), answer);
  }
  return answer;
}

}  // namespace limpid::examples
