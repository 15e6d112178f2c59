// SPDX-License-Identifier: MIT
#include "design_words.hpp"

namespace limpid::examples {

nlohmann::ordered_json settings_of(const DesignTask& task) {
  const auto& tool = task.design.tool;
  nlohmann::ordered_json json{{"theorem", name(task.theorem)},
                              {"tool", {tool.mass, tool.damping, tool.stiffness}},
                              {"period", task.design.T_d},
                              {"delay", task.delay}};
  if (task.over_box) {
    const auto& [lower, upper] = task.box;
    json["box"] = {{lower.stiffness, upper.stiffness}, {lower.damping, upper.damping}};
  } else {
    json["environment"] = {task.environment.stiffness, task.environment.damping};
  }
  if (is_inequality(task.theorem)) json["a2"] = task.design.a2, json["a3"] = task.design.a3;
  if (task.theorem == DesignTheorem::five) json["rates"] = {task.rates.stiffness, task.rates.damping};
  return json;
}

std::string row(const std::string& what, const std::string& finding) {
  return words("%-26s %s\n", what.c_str(), finding.c_str());
}

std::string describe(const InequalityAnswer& answer) {
  std::string text(describe(answer.verdict));
  if (answer.verdict == Verdict::feasible) text += answer.certified ? ", certified" : ", not certified";
  if (answer.verdict == Verdict::infeasible) text += answer.certified ? ", by a dual certificate" : ", not certified";
  if (std::isfinite(answer.margin)) text += words("; margin %.4g", answer.margin);
  if (std::isfinite(answer.by_force)) {
    text += words("; |e| <= %.4g |Delta_T| or %.4g |Delta_theta|, L2", answer.by_sampling, answer.by_force);
  }
  if (answer.verdict == Verdict::undecided) text += ": " + answer.reason;
  return text;
}

std::string describe(const DesignTask& task, const SampledAnswer& answer) {
  const char* of = task.over_box && !answer.on_grid ? "spectral radius at most" : "spectral radius";
  std::string text = answer.stable == Verdict::feasible     ? "stable, proved; "
                     : answer.stable == Verdict::infeasible ? "UNSTABLE; "
                     : answer.on_grid                       ? "stable; "
                                                            : "undecided; ";
  text += words("%s %.4g", of, answer.radius);
  if (answer.on_grid) return text + ", the worst of a grid over the box";
  if (!task.over_box) return text;
  return text + (answer.varying == Verdict::feasible ? "; also where the tissue varies between samples, proved"
                                                     : "; not proved where the tissue varies between samples");
}

std::string describe(const DesignTask& task, const DelayAnswer& answer) {
  return std::string(answer.stable ? "stable" : "UNSTABLE") + "; rightmost root " + describe(answer.root) +
         (task.over_box ? ", the worst of a grid over the box" : "");
}

std::string warning_of(const DesignTask& task, const InequalityAnswer& inequality, const SampledAnswer& sampled) {
  const std::string theorem = std::string("Theorem ") + name(task.theorem);
  if (inequality.verdict == Verdict::feasible && sampled.stable == Verdict::infeasible) {
    return theorem + words(
                         " certifies the continuous delay system, yet the sampled predictor is UNSTABLE with radius "
                         "%.4g:\nthe theorem takes sampling for a bounded disturbance, and says nothing of the loop "
                         "that it closes. Do not use this gain.\n",
                         sampled.radius);
  }
  if (inequality.verdict == Verdict::infeasible && sampled.stable == Verdict::feasible) {
    return theorem + words(
                         " has no certificate for this gain, yet the sampled predictor is stable with radius %.4g: "
                         "the inequality is\nsufficient, not necessary.\n",
                         sampled.radius);
  }
  return {};
}

std::string remark_on_margin(const DesignTask& task, const InequalityAnswer& inequality) {
  if (!task.over_box || inequality.verdict != Verdict::feasible || !(inequality.margin <= 0)) return {};
  return "The margin is that of one X for the whole box, as printed; the verdict needs P, Q, R in common alone.\n";
}

std::string no_gain(const DesignTask& task) {
  if (!task.over_box || task.theorem == DesignTheorem::five) return "No gain satisfies the inequality there.\n";
  return "No gain satisfies it there with P, Q, R and X in common; `verify` asks for no common X and may accept one.\n";
}

}  // namespace limpid::examples
