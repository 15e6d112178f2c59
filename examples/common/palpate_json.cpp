// SPDX-License-Identifier: MIT
#include "palpate_json.hpp"

#include "windows.hpp"

#include <nlohmann/json.hpp>

namespace limpid::examples {

namespace {

using Json = nlohmann::ordered_json;

// What there is of them.
Json disturbances_of(const Disturbances& disturbances) {
  const auto& [tissue, step_at, sensing, seed] = disturbances;
  Json json = Json::object();
  if (tissue.step != 1) json["stiffness_step"] = {step_at, tissue.step};
  if (tissue.relaxation > 0) json["relaxation"] = {tissue.relaxation, tissue.lag};
  const auto add = [&](const char* what, double size) {
    if (size > 0) json[what] = size;
  };
  add("soften", tissue.softening);
  add("depth_damping", tissue.damping_growth);
  add("coulomb", tissue.friction);
  if (!sensing.any()) return json;
  add("force_noise", sensing.force_noise);
  json["state_noise"] = {sensing.position_noise, sensing.velocity_noise};
  json["quantise"] = {sensing.position_step, sensing.force_step};
  add("jitter", sensing.jitter);
  add("loss", sensing.loss);
  json["seed"] = seed;
  return json;
}

Json settings_of(const Scene& scene) {
  const Tissue& tissue = scene.tissue;
  Json json{{"force", scene.force.description},
            {"duration", in_seconds(scene.duration)},
            {"rate", 1 / in_seconds(scene.tick)},
            {"sample_period", in_seconds(scene.period)},
            {"delay", in_seconds(scene.delay)},
            {"environment", name(tissue.kind)},
            {"stiffness", tissue.stiffness},
            {"damping", tissue.damping},
            {"unilateral", tissue.unilateral},
            {"tool", {scene.tool.mass, scene.tool.damping, scene.tool.stiffness}},
            {"gain", scene.gain},
            {"known", scene.estimation.known},
            {"robot", scene.robot == RobotKind::ideal ? "ideal" : "realistic"},
            {"playback", scene.playback}};
  if (scene.live) json["device"] = scene.live->device == DeviceKind::usb ? "usb" : "simulated, by the machine's clock";
  if (tissue.kind == TissueKind::smooth_bilinear) {
    json["stiffness"] = {tissue.stiffness, tissue.stiffness2};
    json["depth"] = tissue.depth;
    json["sharpness"] = tissue.sharpness;
  }
  if (tissue.kind == TissueKind::hunt_crossley) json["exponent"] = tissue.exponent;
  if (tissue.kind == TissueKind::exponential) {
    json.erase("stiffness");
    json["amplitude"] = tissue.amplitude;
    json["growth"] = tissue.growth;
  }
  if (tissue.kind == TissueKind::layered) {
    json["stiffness"] = tissue.layers;
    json["boundaries"] = tissue.boundaries;
  }
  if (scene.force_sensor) {
    json["force_sensor"] = {{"cross_talk", scene.force_sensor->cross_talk}, {"noise", scene.force_sensor->noise}};
  }
  if (tissue.wall) json["wall"] = *tissue.wall;
  if (const Json disturbances = disturbances_of(scene.disturbances); !disturbances.empty()) {
    json["disturbances"] = disturbances;
  }
  json["operator"] = scene.hand ? "hand" : "force";
  if (!scene.estimation.known) json["start"] = {scene.estimation.stiffness, scene.estimation.damping};
  return json;
}

Json norms(const ErrorNorms<3>& error) {
  return {{"max", error.total().max},
          {"l2", error.total().l2},
          {"position", {{"max", error.position().max}, {"l2", error.position().l2}}},
          {"velocity", {{"max", error.velocity().max}, {"l2", error.velocity().l2}}}};
}

Json ticks(const LatencyHistogram& tick) {
  return {{"p50", tick.quantile(0.5).count()},
          {"p99", tick.quantile(0.99).count()},
          {"p99.9", tick.quantile(0.999).count()},
          {"max", tick.max().count()}};
}

Json energies(const HandEnergy<>& energy) {
  return {{"work", energy.work},
          {"kinetic", energy.kinetic},
          {"elastic", energy.elastic},
          {"dissipated", energy.dissipated},
          {"delivered", energy.delivered}};
}

Json changes(const PalpationResult& result, const PalpationResult& hold) {
  const Norms<> prediction = result.prediction.total(), held = hold.prediction.total();
  const Norms<> total = result.total.total(), held_total = hold.total.total();
  return {{"prediction_max", relative_change(prediction.max, held.max)},
          {"prediction_l2", relative_change(prediction.l2, held.l2)},
          {"total_max", relative_change(total.max, held_total.max)},
          {"total_l2", relative_change(total.l2, held_total.l2)}};
}

// Of the prediction, (3.35), at each tick.
std::vector<double> squared_errors(const PalpationResult& result) {
  std::vector<double> squares;
  squares.reserve(result.trace.size());
  for (const TracePoint& point : result.trace) squares.push_back(point.prediction_error * point.prediction_error);
  return squares;
}

Json windows(const std::vector<Window>& all) {
  Json json = Json::array();
  for (const auto& [start, ratio, hold_error, judged] : all) {
    json.push_back({{"start", start}, {"error_over_hold", ratio}, {"hold_error", hold_error}, {"judged", judged}});
  }
  return json;
}

Json live(const LiveReport& of) {
  const LiveDeviceReport& device = of.device;
  Json json{{"ticks", of.loop.ticks},
            {"missed", of.loop.missed},
            {"overruns", of.loop.overruns},
            {"lateness_ns", ticks(of.loop.lateness)},
            {"work_ns", ticks(of.loop.work)},
            {"samples", of.samples},
            {"ticks_without_force", of.without_force}};
  if (device.calls.count() == 0) return json;
  json["usb"] = {{"states_per_second", device.states_per_second},
                 {"used_in_their_tick", device.used_in_their_tick},
                 {"lost", device.lost},
                 {"damaged", device.damaged},
                 {"commands", device.commands},
                 {"dropped", device.dropped},
                 {"calls_ns", ticks(device.calls)},
                 {"fault", device.fault}};
  return json;
}

Json report(const Scene& scene, const std::vector<PalpationRun>& runs, const PalpationResult* reference) {
  Json json{{"settings", settings_of(scene)}};
  if (scene.hand) {
    json["operator"] = {
        {"mass", scene.hand->mass}, {"damping", scene.hand->damping}, {"stiffness", scene.hand->stiffness}};
  }
  json["predictors"] = Json::object();
  const PalpationResult* hold = hold_of(runs);
  const std::vector<double> of_hold = reference != nullptr ? squared_errors(*reference) : std::vector<double>{};
  LatencyHistogram all;
  for (const PalpationRun& run : runs) {
    const PalpationResult& result = run.result;
    Json& entry = json["predictors"][name(run.predictor)];
    entry["prediction_error"] = norms(result.prediction);
    entry["total_error"] = norms(result.total);
    if (hold != nullptr) entry["change"] = changes(result, *hold);
    if (scene.hand) entry["energy"] = energies(result.energy);
    entry["tick_ns"] = ticks(result.tick);
    if (reference != nullptr)
      entry["windows"] = windows(windows_of(squared_errors(result), of_hold, in_seconds(scene.tick)));
    if (result.live) entry["live"] = live(*result.live);
    entry["status"] = describe(result.status);
    entry["fault"] = has(result.status, Status::fault);
    all.merge(result.tick);
  }
  json["tick_ns"] = ticks(all);
  return json;
}

}  // namespace

std::string as_json(const Scene& scene, const std::vector<PalpationRun>& runs, const PalpationResult* hold) {
  return report(scene, runs, hold).dump(2) + '\n';
}

}  // namespace limpid::examples
