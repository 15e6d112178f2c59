// SPDX-License-Identifier: MIT
#include "design_instances.hpp"
#include "design_report.hpp"
#include "design_words.hpp"

namespace limpid::examples {

namespace {

const char* name(DesignCriterion criterion) {
  switch (criterion) {
    case DesignCriterion::margin:
      return "largest margin";
    case DesignCriterion::bound:
      return "smallest error bound";
    case DesignCriterion::radius:
      return "smallest sampled radius";
    default:
      return "first one found";
  }
}

std::string heading(const DesignTask& task) {
  if (task.theorem == DesignTheorem::sampled) return "smallest sampled radius";
  std::string text = std::string("Theorem ") + name(task.theorem);
  if (task.knots == 0) text += std::string(", ") + name(task.criterion);
  if (task.theorem != DesignTheorem::five) return text;
  if (task.knots > 0) text += words(", B-splines of %d knots", task.knots);
  return text + words(", |k_e'| <= %.6g N/m/s, |b_e'| <= %.6g N s/m/s", task.rates.stiffness, task.rates.damping);
}

void add_knots(DesignReport& report, const InequalityAnswer& answer) {
  if (answer.at_knots.empty()) return;
  for (const auto& [knot, gain] : answer.at_knots) {
    report.json["gain_at_knots"].push_back({knot.stiffness, knot.damping, gain[0], gain[1]});
    report.words +=
        row(words("k_e = %.6g, b_e = %.6g", knot.stiffness, knot.damping), words("L = [%.6g %.6g]", gain[0], gain[1]));
  }
  report.words += "Between the knots L is bilinear.\n";
}

// Over a box the gain of smallest radius is the robust one.
DesignReport solve_robust(const DesignTask& task) {
  DesignReport report = robust(task);
  const bool proved = report.json["proved"].get<bool>();
  report.json["feasible"] = proved && report.json["worst_radius"].get<double>() < 1;
  report.json["margin"] = nullptr;
  report.json["certified"] = proved;
  return report;
}

}  // namespace

DesignReport solve(const DesignTask& task) {
  const bool sampled_only = task.theorem == DesignTheorem::sampled;
  if (sampled_only && task.over_box) return solve_robust(task);
  const InequalityAnswer answer = sampled_only ? ask_for_sampled_gain(task) : ask_for_gain(task);
  DesignReport report{.gain = answer.gain};
  const bool scheduled = task.theorem == DesignTheorem::five;
  report.json = {{"feasible", answer.verdict == Verdict::feasible},
                 {"gain", nullptr},
                 {"margin", number_or_null(answer.margin)},
                 {"certified", answer.certified},
                 {"verdict", limpid::describe(answer.verdict)}};
  if (answer.verdict == Verdict::undecided) report.json["reason"] = answer.reason;
  report.words = heading(task) + " at " + place_of(task) + "\n";
  if (answer.gain) {
    const SampledAnswer sampled = ask_sampled(task, *answer.gain);
    const DelayAnswer delay = ask_delay(task, *answer.gain);
    report.json["gain"] = numbers_of(*answer.gain, scheduled);
    report.json["sampled_radius"] = number_or_null(sampled.radius);
    report.json["delay_root"] = number_or_null(delay.root.real());
    report.json["bound_by_sampling"] = number_or_null(answer.by_sampling);
    report.json["bound_by_force"] = number_or_null(answer.by_force);
    report.words += row("gain", describe(*answer.gain, scheduled)) + row("verdict", describe(answer)) +
                    remark_on_margin(task, answer) + row("sampled predictor", describe(task, sampled)) +
                    row("continuous delay system", describe(task, delay)) + warning_of(task, answer, sampled);
  } else {
    add_knots(report, answer);
    report.words += row("verdict", describe(answer));
    if (answer.verdict == Verdict::infeasible) report.words += no_gain(task);
  }
  report.json["settings"] = settings_of(task);
  return report;
}

}  // namespace limpid::examples
