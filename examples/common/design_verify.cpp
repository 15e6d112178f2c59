// SPDX-License-Identifier: MIT
#include "design_report.hpp"
#include "design_words.hpp"

namespace limpid::examples {

namespace {

using Json = nlohmann::ordered_json;

// The verdict that was asked for.
struct Asked {
  Verdict verdict;
  bool certified;
  std::string reason;
};

Asked asked_of(const DesignTask& task, const InequalityAnswer& inequality, const SampledAnswer& sampled,
               const DelayAnswer& delay) {
  if (is_inequality(task.theorem)) return {inequality.verdict, inequality.certified, inequality.reason};
  if (task.theorem == DesignTheorem::sampled) {
    return {sampled.stable, sampled.stable != Verdict::undecided, "the radius is too close to 1, or the box too large"};
  }
  return {delay.stable ? Verdict::feasible : Verdict::infeasible, false, "computed, not proved"};
}

void add_stability(Json& json, const SampledAnswer& sampled, const DelayAnswer& delay) {
  json["sampled_radius"] = number_or_null(sampled.radius);
  json["sampled_stable"] = sampled.stable == Verdict::feasible;
  json["delay_root"] = number_or_null(delay.root.real());
  json["delay_root_imaginary"] = number_or_null(std::abs(delay.root.imag()));
  json["delay_stable"] = delay.stable;
}

}  // namespace

DesignReport verify(const DesignTask& task) {
  const InequalityAnswer inequality = is_inequality(task.theorem) ? ask_inequality(task) : InequalityAnswer{};
  const SampledAnswer sampled = ask_sampled(task, *task.gain);
  const DelayAnswer delay = ask_delay(task, *task.gain);
  const Asked asked = asked_of(task, inequality, sampled, delay);

  DesignReport report{.gain = task.gain};
  report.json = {{"feasible", asked.verdict == Verdict::feasible},
                 {"margin", number_or_null(inequality.margin)},
                 {"certified", asked.certified},
                 {"verdict", limpid::describe(asked.verdict)}};
  if (asked.verdict == Verdict::undecided) report.json["reason"] = asked.reason;
  add_stability(report.json, sampled, delay);
  if (task.over_box) report.json["sampled_stable_varying"] = sampled.varying == Verdict::feasible;
  report.json["gain"] = numbers_of(*task.gain, task.scheduled);
  report.json["settings"] = settings_of(task);

  report.words = describe(*task.gain, task.scheduled) + " at " + place_of(task) + "\n";
  if (is_inequality(task.theorem)) {
    report.words +=
        row(std::string("Theorem ") + name(task.theorem), describe(inequality)) + remark_on_margin(task, inequality);
  }
  report.words += row("sampled predictor", describe(task, sampled)) +
                  row("continuous delay system", describe(task, delay)) + warning_of(task, inequality, sampled);
  return report;
}

}  // namespace limpid::examples
