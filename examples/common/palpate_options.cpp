// SPDX-License-Identifier: MIT
#include "palpate_options.hpp"

#include "option_checks.hpp"
#include "option_values.hpp"
#include "output_file.hpp"
#include "palpate_disturbance_options.hpp"
#include "palpate_live_options.hpp"
#include "palpate_predictor_options.hpp"
#include "palpate_tissue_options.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <utility>

namespace limpid::examples {

namespace {

// As typed; what is absent takes its default from the rest.
struct Typed {
  TypedTissue tissue;
  TypedDisturbances disturbances;
  TypedPredictors predictors;
  TypedLive live;
  std::string force_file, robot = "ideal", json, csv, plot;
  std::vector<double> raised_cosine, sine, tool{0.1, 0.1, 0};
  std::vector<std::string> person{"force"};
  std::string force_sensor = "none";
  double cross_talk = 0, sensor_noise = 0.01;
  double force_scale = 1, sample_period = 0.1, delay = 0, duration = 20, rate = 1000;
  bool playback = false;
};

void add_options(CLI::App& app, Typed& typed) {
  const auto any = within(-1e6, 1e6);
  const auto seconds = within(1e-6, 1e4);
  CLI::Option* file = app.add_option("--force", typed.force_file, "recorded operator's force: CSV of time, force")
                          ->check(CLI::ExistingFile);
  app.add_option("--force-scale", typed.force_scale, "newtons per unit of the recording")->check(any)->needs(file);
  CLI::Option* cosine =
      app.add_option("--force-raised-cosine", typed.raised_cosine, "AMPLITUDE,HZ: A (1 - cos(2 pi f t))/2");
  CLI::Option* sine = app.add_option("--force-sine", typed.sine, "AMPLITUDE,HZ: A sin(2 pi f t)");
  for (CLI::Option* shape : {cosine, sine}) shape->delimiter(',')->expected(2)->check(any);
  cosine->excludes(file);
  sine->excludes(file)->excludes(cosine);

  app.add_option("--operator", typed.person,
                 "force: as given, whatever the tip does; or hand M,B,K: it is the intention of a hand, kg, N s/m, N/m")
      ->expected(1, 2)
      ->type_name("force|hand M,B,K");

  app.add_option("--force-sensor", typed.force_sensor, "none: the operator's force is known; simulated: by a sensor")
      ->check(CLI::IsMember({"none", "simulated"}));
  app.add_option("--sensor-cross-talk", typed.cross_talk, "of each axis on each other, a part; needs the sensor")
      ->check(within(0, 1));
  app.add_option("--sensor-noise", typed.sensor_noise, "standard deviation, N; needs the sensor")->check(within(0, 10));

  add_tissue_options(app, typed.tissue);
  add_disturbance_options(app, typed.disturbances);
  app.add_option("--tool", typed.tool, "M,B,K: kg, N s/m, N/m")->delimiter(',')->expected(3)->check(within(0, 1e6));
  app.add_option("--sample-period", typed.sample_period, "T_d of the tissue, s")->check(seconds);
  app.add_option("--delay", typed.delay, "from sample to arrival, s; default: the period")->check(within(0, 1e4));
  add_predictor_options(app, typed.predictors);

  add_live_options(app, typed.live);
  app.add_option("--robot", typed.robot, "the simulated Omni")->check(CLI::IsMember({"ideal", "realistic"}));
  app.add_flag("--playback", typed.playback, "the operator's force does not act on the arm");
  app.add_option("--duration", typed.duration, "s; default 20, or the recording's length")->check(within(0, 1e5, true));
  app.add_option("--rate", typed.rate, "ticks per second")->check(within(50, 2e4));
  app.add_option("--json", typed.json, "write the figures here")->check(output());
  app.add_option("--csv", typed.csv, "write the signals here")->check(output());
  app.add_option("--plot", typed.plot, "draw force, motion and error here (SVG)")->check(output());
}

void refuse_same_outputs(const Typed& typed) {
  std::vector<std::string> outputs;
  for (const std::string& path : {typed.json, typed.csv, typed.plot}) {
    if (path.empty()) continue;
    if (std::any_of(outputs.begin(), outputs.end(), [&](const auto& other) { return is_same_file(path, other); })) {
      refuse("--json, --csv, --plot", "accept different files, got " + path + " twice");
    }
    outputs.push_back(path);
  }
}

std::optional<HandModel> hand_of(const Typed& typed) {
  if (typed.person.size() == 1 && typed.person[0] == "force") return {};
  const auto numbers = typed.person.size() == 2 && typed.person[0] == "hand" ? numbers_of(typed.person[1], ",,")
                                                                             : std::optional<std::vector<double>>{};
  if (!numbers) refuse("--operator", "accepts force, or hand M,B,K");
  const HandModel hand{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  if (hand.mass < 1e-3 || hand.mass > 1e3) {
    refuse("--operator", "accepts a mass in [0.001, 1000], got " + text(hand.mass));
  }
  // The arm takes the hand's force once a tick of 1 ms: beyond these the simulation itself would make energy.
  if (hand.damping < 0 || hand.damping > 100) {
    refuse("--operator", "accepts a damping in [0, 100], got " + text(hand.damping));
  }
  if (hand.stiffness < 0 || hand.stiffness > 1e4) {
    refuse("--operator", "accepts a stiffness in [0, 1e4], got " + text(hand.stiffness));
  }
  if (typed.playback) refuse("--playback", "goes with --operator force: a hand holds the arm");
  return hand;
}

PressForce force_of(const CLI::App& app, const Typed& typed) {
  const Duration wanted = from_seconds(typed.duration);
  if (!typed.raised_cosine.empty()) return raised_cosine_force(typed.raised_cosine[0], typed.raised_cosine[1], wanted);
  if (!typed.sine.empty()) return sine_force(typed.sine[0], typed.sine[1], wanted);
  PressForce force =
      typed.force_file.empty() ? press_like_force() : recorded_force(typed.force_file, typed.force_scale);
  if (app.count("--duration") > 0 && wanted > force.duration) {
    refuse("--duration", "accepts up to " + text(in_seconds(force.duration)) + " s, the length of " +
                             force.description + ", got " + text(typed.duration));
  }
  if (app.count("--duration") > 0) force.duration = wanted;
  return force;
}

std::optional<ForceSensorModel> sensor_of(const CLI::App& app, const Typed& typed) {
  if (typed.force_sensor == "simulated") return ForceSensorModel{typed.cross_talk, typed.sensor_noise};
  for (const char* option : {"--sensor-cross-talk", "--sensor-noise"}) {
    if (app.count(option) > 0) refuse(option, "goes with --force-sensor simulated");
  }
  return {};
}

// Where nothing pulls: a tissue that is touched at a wall could not keep hold of a tool that is pulled at.
PressForce only_pressing(PressForce force) {
  force.at = [pulled = std::move(force.at)](Time t) { return std::max(pulled(t), 0.0); };
  return force;
}

Scene scene_of(const CLI::App& app, const Typed& typed) {
  if (typed.tool[0] < 1e-6) refuse("--tool", "accepts a mass of 1e-6 kg or more, got " + text(typed.tool[0]));
  Scene scene;
  scene.tissue = tissue_of(app, typed.tissue);
  scene.estimation = estimation_of(typed.predictors, scene.tissue);
  scene.gain = typed.predictors.gain;
  scene.tool = {.mass = typed.tool[0], .damping = typed.tool[1], .stiffness = typed.tool[2]};
  scene.force = force_of(app, typed);
  if (scene.tissue.wall) scene.force = only_pressing(std::move(scene.force));
  scene.duration = scene.force.duration;
  scene.tick = from_seconds(1 / typed.rate);
  scene.period = from_seconds(typed.sample_period);
  scene.delay = app.count("--delay") > 0 ? from_seconds(typed.delay) : scene.period;
  if (scene.period < scene.tick) {
    refuse("--sample-period", "accepts no less than a tick of --rate, " + text(in_seconds(scene.tick)) + " s, got " +
                                  text(typed.sample_period));
  }
  const Duration longest_delay = std::min(64 * scene.period, 4000 * scene.tick);  // what sampler and predictor hold
  if (scene.delay >= longest_delay) {
    refuse(app.count("--delay") > 0 ? "--delay" : "--sample-period",
           "accepts a delay of less than 64 sample periods and 4000 ticks, " + text(in_seconds(longest_delay)) +
               " s, got " + text(in_seconds(scene.delay)));
  }
  if (scene.duration / scene.tick > 10'000'000) {
    refuse(app.count("--duration") > 0 ? "--duration" : "--force",
           "accepts up to 1e7 ticks, got " + text(in_seconds(scene.duration)) + " s at " + text(typed.rate) + " Hz");
  }
  if (scene.duration <= scene.period + scene.delay) {
    refuse("--duration", "accepts more than the sample period and the delay together");
  }
  scene.disturbances = disturbances_of(typed.disturbances, in_seconds(scene.duration));
  // of a device on USB too: its torques are limited, its parameters are Table 5.2's
  const bool realistic = typed.robot == "realistic" || typed.live.device == "usb";
  scene.robot = realistic ? RobotKind::realistic : RobotKind::ideal;
  scene.hand = hand_of(typed);
  scene.force_sensor = sensor_of(app, typed);
  scene.playback = typed.playback;
  return scene;
}

}  // namespace

PalpateOptions parse_palpate_options(int argc, const char* const* argv) {
  CLI::App app{"A hand presses a simulated Phantom Omni against a slow tissue, with and without prediction.",
               "palpate"};
  Typed typed;
  add_options(app, typed);
  PalpateOptions options;
  try {
    app.parse(argc, argv);
    options.predictors = predictors_of(app, typed.predictors);
    refuse_same_outputs(typed);
    options.scene = scene_of(app, typed);
    options.scene.live = live_of(app, typed.live, options.scene, options.predictors.size());
    refuse_unserved(options.predictors, options.scene);
  } catch (const CLI::ParseError& error) {
    options.exit_code = app.exit(error);
    return options;
  }
  options.json = typed.json;
  options.csv = typed.csv;
  options.plot = typed.plot;
  return options;
}

}  // namespace limpid::examples
