// SPDX-License-Identifier: MIT
#include "transparency_findings.hpp"
#include "words.hpp"

namespace limpid::examples {

namespace {

using Json = nlohmann::ordered_json;

Json settings_of(const TransparencyTask& task) {
  const auto& problem = task.problem;
  Json json{{"mass", problem.plant.mass},
            {"damping", problem.plant.damping},
            {"stiffness", problem.wall.stiffness},
            {"wall_damping", problem.wall.damping},
            {"period", problem.period},
            {"uncertainty", {problem.uncertainty.alpha, problem.uncertainty.beta}},
            {"weight", task.weight},
            {"zoh", std::string(describe(problem.hold).substr(0, 1))},
            {"delay", task.delay},
            {"cutoff", number_or_null(task.cutoff)},
            {"radius", task.radius}};
  return json;
}

Json as_json(const GainInterval<>& interval) {
  if (interval.empty()) return nullptr;
  return {interval.lower, number_or_null(interval.upper)};
}

Json as_json(const GainFigures& figures) {
  return {{"gain", figures.gain.B_c},
          {"index", number_or_null(figures.index)},
          {"norm", number_or_null(figures.norm)},
          {"peak", number_or_null(figures.peak)}};
}

// "proved": null where it is neither proved nor refuted
Json as_json(const SampledVerdict& found) {
  Json proved = found.verdict == Verdict::feasible;
  if (found.verdict == Verdict::undecided) proved = nullptr;
  return {{"gain", found.gain},
          {"proved", proved},
          {"mass", found.plant.mass},
          {"damping", found.plant.damping},
          {"radius", number_or_null(found.radius)}};
}

Json as_json(const std::optional<OfferedGain>& offered) {
  if (!offered) return nullptr;
  Json json = as_json(offered->figures);
  json.update(as_json(offered->sampled));
  return json;
}

Json as_json(const SampledFindings& sampled) {
  Json gains = Json::array();
  for (const SampledVerdict& gain : sampled.gains) gains.push_back(as_json(gain));
  return {{"sampled_interval", as_json(sampled.nominal)},
          {"robust_sampled_interval", as_json(sampled.robust)},
          {"optimum", sampled.optimum ? as_json(*sampled.optimum) : Json(nullptr)},
          {"gains", gains},
          {"offered", as_json(sampled.offered)}};
}

Json as_json(const StepResponse& step) {
  Json points = Json::array();
  for (std::size_t i = 0; i < step.points.size(); ++i) {
    points.push_back({{"time", StepResponse::times[i]}, {"position", number_or_null(step.points[i])}});
  }
  return {{"gain", step.gain},
          {"end", step.end},
          {"overshoot", number_or_null(step.overshoot)},
          {"settling", number_or_null(step.settling)},
          {"points", points},
          {"trace", {{"time", step.time}, {"position", step.position}, {"force", step.force}}}};
}

}  // namespace

nlohmann::ordered_json as_json(const TransparencyTask& task, const TransparencyFindings& findings) {
  Json json{{"settings", settings_of(task)}, {"stiffness_gain", findings.K_c}};
  json["optimum"] =
      findings.optimum ? as_json(*findings.optimum) : Json{{"gain", nullptr}, {"index", nullptr}, {"norm", nullptr}};
  if (task.free) json["optimum"]["stiffness_gain"] = findings.optimum ? Json(findings.K_c) : Json(nullptr);
  json["robust_interval"] = as_json(findings.robust);
  const Json first = as_json(findings.sampled.front());
  json["velocity"] = name(findings.sampled.front().velocity);
  for (const char* interval : {"sampled_interval", "robust_sampled_interval", "offered"}) {
    json[interval] = first[interval];
  }
  json["table"] = Json::array();
  for (const GainFigures& row : findings.table) json["table"].push_back(as_json(row));
  for (const SampledFindings& sampled : findings.sampled) json["sampled"][name(sampled.velocity)] = as_json(sampled);
  if (!task.force) return json;
  json["step_velocity"] = name(task.step_velocity);
  json["step"] = Json::array();
  for (const StepResponse& step : findings.steps) json["step"].push_back(as_json(step));
  return json;
}

}  // namespace limpid::examples
