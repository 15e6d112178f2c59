// SPDX-License-Identifier: MIT
#include "design_cell.hpp"
#include "design_instances.hpp"

#include <limpid/design/delay_stability.hpp>
#include <limpid/design/sampled_proof.hpp>
#include <limpid/design/sampled_stability.hpp>
#include <limpid/design/theorem3.hpp>
#include <limpid/design/theorem3_design.hpp>

#include <span>

namespace limpid::examples {

namespace {

using Neighbour = const CellAnswer*;

template <typename Found>
void take(const Found& found, CellAnswer& answer) {
  answer.verdict = found.verdict;
  answer.certified = found.verdict != Verdict::undecided;
  if (!answer.certified) answer.reason = found.reason;
}

using Part = std::function<void(const limpid::Tissue<>&, Neighbour, CellAnswer&)>;

Part by_one_certificate(const DesignTask& task) {
  return [holds = one_certificate(task.design, *task.gain, task.environment)](const limpid::Tissue<>& tissue, Neighbour,
                                                                              CellAnswer& answer) {
    answer.certified = holds && holds(tissue);
    answer.verdict = answer.certified ? Verdict::feasible : Verdict::undecided;
    if (!answer.certified) answer.reason = "the variables found at the environment do not serve here";
  };
}

Part by_theorem3(const DesignTask& task) {
  if (!task.gain) {
    return [design = task.design](const limpid::Tissue<>& tissue, Neighbour, CellAnswer& answer) {
      take(design_theorem3(design, tissue), answer);
    };
  }
  return [design = task.design, L = task.gain->L0](const limpid::Tissue<>& tissue, Neighbour neighbour,
                                                   CellAnswer& answer) {
    const auto found = verify_theorem3(design, tissue, L, neighbour == nullptr ? nullptr : &neighbour->certificate);
    take(found, answer);
    answer.certificate = found.certificate;
  };
}

Part by_sampled_proof(const DesignTask& task) {
  const SampledSystem<> system{.tool = task.design.tool, .period = task.design.T_d, .delay = task.delay};
  return [system, gain = *task.gain](const limpid::Tissue<>& tissue, Neighbour, CellAnswer& answer) {
    take(prove_sampled_stability(system, tissue, gain(tissue)), answer);
  };
}

// Computed, not proved: not certified.
Part by_delay_root(const DesignTask& task) {
  const DelaySystem<> system{.tool = task.design.tool, .delay = task.design.T_d};
  return [system, gain = *task.gain](const limpid::Tissue<>& tissue, Neighbour, CellAnswer& answer) {
    answer.verdict = delay_stable(system, tissue, gain(tissue)) ? Verdict::feasible : Verdict::infeasible;
  };
}

Part verdict_of(const DesignTask& task) {
  switch (task.theorem) {
    case DesignTheorem::five:
      return by_one_certificate(task);
    case DesignTheorem::sampled:
      return by_sampled_proof(task);
    case DesignTheorem::delay:
      return by_delay_root(task);
    default:
      return by_theorem3(task);
  }
}

Part stability_of(const DesignTask& task) {
  const SampledStability<> sampled({.tool = task.design.tool, .period = task.design.T_d, .delay = task.delay});
  const DelaySystem<> continuous{.tool = task.design.tool, .delay = task.design.T_d};
  return [continuous, sampled, gain = *task.gain](const limpid::Tissue<>& tissue, Neighbour, CellAnswer& answer) {
    answer.radius = sampled.radius(tissue, gain(tissue));
    answer.root = without_rounding(rightmost_delay_root(continuous, tissue, gain(tissue)));
  };
}

}  // namespace

CellTest::CellTest(const DesignTask& task, bool with_stability) : verdict_{verdict_of(task)} {
  if (task.gain && with_stability) stability_ = stability_of(task);
}

CellAnswer CellTest::operator()(const limpid::Tissue<>& tissue, Neighbour neighbour) const {
  CellAnswer answer;
  verdict_(tissue, neighbour, answer);
  if (stability_) stability_(tissue, neighbour, answer);
  return answer;
}

// At rho_0 alone P_1 = P_2 = 0 is best, whatever the rates, and leaves P, Q and R of Theorem 3 there.
std::function<bool(const limpid::Tissue<>&)> one_certificate(const PredictorDesign<>& design, const AffineGain<>& L,
                                                             const limpid::Tissue<>& nominal) {
  const auto found = verify_theorem3(design, nominal, L(nominal));
  if (found.verdict != Verdict::feasible) return {};
  const double d = detail::time_scale(design, nominal);  // of the coordinates that P, Q and R are in
  return [=](const limpid::Tissue<>& tissue) {
    const detail::FixedGainLmi<double, 1> here(design, std::span<const limpid::Tissue<>>(&tissue, 1), L(tissue), d);
    return here.proves_feasible(found.certificate.lyapunov);
  };
}

}  // namespace limpid::examples
