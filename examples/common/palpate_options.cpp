// SPDX-License-Identifier: MIT
#include "palpate_options.hpp"

#include "number_list.hpp"
#include "output_file.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace limpid::examples {

namespace {

// As typed; what is absent takes its default from the rest.
struct Typed {
  std::string force_file, environment = "kelvin-voigt", robot = "ideal", json, csv, plot;
  std::vector<double> raised_cosine, sine, stiffness, tool{0.1, 0.1, 0}, gain{0, 0}, start;
  std::vector<std::string> predictors{"all"}, person{"force"};
  double force_scale = 1, depth = 0.0028, sharpness = 20, exponent = 1.3, damping = 30;
  double sample_period = 0.1, delay = 0, duration = 20, rate = 1000;
  bool known = false, unilateral = false, playback = false;
};

[[noreturn]] void refuse(const std::string& option, const std::string& accepts) {
  throw CLI::ValidationError(option, accepts);
}

std::string text(double value) {
  std::ostringstream words;
  words << value;
  return words.str();
}

// A path to write to.
CLI::Validator output() {
  return CLI::Validator([](std::string& typed) { return refusal_of_output(typed); }, "", "output");
}

// Finite numbers of [least, most]; `open` leaves `least` itself out.
CLI::Validator within(double least, double most, bool open = false) {
  std::ostringstream words;
  words << "a number in " << (open ? "(" : "[") << least << ", " << most << "]";
  return CLI::Validator(
      [=, text = words.str()](std::string& typed) -> std::string {
        double value = 0;
        const bool number = CLI::detail::lexical_cast(typed, value) && std::isfinite(value);
        const bool inside = number && value <= most && (open ? value > least : value >= least);
        return inside ? std::string{} : "accepts " + text + ", got " + typed;
      },
      "", "within");
}

void add_options(CLI::App& app, Typed& typed) {
  const auto any = within(-1e6, 1e6);
  const auto positive = within(0, 1e6, true), not_negative = within(0, 1e6);
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

  app.add_option("--environment", typed.environment, "the tissue")
      ->check(CLI::IsMember({"kelvin-voigt", "smooth-bilinear", "hunt-crossley"}));
  app.add_option("--stiffness", typed.stiffness, "K, N/m; K1,K2 for smooth-bilinear")
      ->delimiter(',')
      ->expected(1, 2)
      ->check(not_negative);
  app.add_option("--depth", typed.depth, "XS of smooth-bilinear, m")->check(positive);
  app.add_option("--sharpness", typed.sharpness, "R of smooth-bilinear")->check(positive);
  app.add_option("--exponent", typed.exponent, "N of hunt-crossley")->check(within(1, 10));
  app.add_option("--damping", typed.damping, "B, N s/m")->check(not_negative);
  app.add_flag("--unilateral", typed.unilateral, "the tool may leave the wall");

  app.add_option("--tool", typed.tool, "M,B,K: kg, N s/m, N/m")->delimiter(',')->expected(3)->check(not_negative);
  app.add_option("--sample-period", typed.sample_period, "T_d of the tissue, s")->check(seconds);
  app.add_option("--delay", typed.delay, "from sample to arrival, s; default: the period")->check(within(0, 1e4));
  app.add_option("--predictor", typed.predictors, "hold,model,ideal or all")
      ->delimiter(',')
      ->check(CLI::IsMember({"hold", "model", "ideal", "all"}));
  app.add_option("--gain", typed.gain, "L1,L2 or six numbers: L0, L1, L2 of a scheduled gain")
      ->delimiter(',')
      ->expected(2, 6)
      ->check(any);
  app.add_flag("--known", typed.known, "the predictor knows the tissue");
  app.add_option("--start", typed.start, "K,B: where the estimate starts")
      ->delimiter(',')
      ->expected(2)
      ->check(not_negative);

  app.add_option("--robot", typed.robot, "the simulated Omni")->check(CLI::IsMember({"ideal", "realistic"}));
  app.add_flag("--playback", typed.playback, "the operator's force does not act on the arm");
  app.add_option("--duration", typed.duration, "s; default 20, or the recording's length")->check(within(0, 1e5, true));
  app.add_option("--rate", typed.rate, "ticks per second")->check(within(50, 2e4));
  app.add_option("--json", typed.json, "write the figures here")->check(output());
  app.add_option("--csv", typed.csv, "write the signals here")->check(output());
  app.add_option("--plot", typed.plot, "draw force, motion and error here (SVG)")->check(output());
}

void refuse_strangers(const CLI::App& app, const Typed& typed) {
  const auto only_with = [&](const char* option, const char* environment) {
    if (app.count(option) > 0 && typed.environment != environment) {
      refuse(option, std::string("goes with --environment ") + environment + ", got " + typed.environment);
    }
  };
  only_with("--depth", "smooth-bilinear");
  only_with("--sharpness", "smooth-bilinear");
  only_with("--exponent", "hunt-crossley");
  if (typed.stiffness.size() == 2 && typed.environment != "smooth-bilinear") {
    refuse("--stiffness", "accepts one number K with --environment " + typed.environment + ", got two");
  }
  if (typed.stiffness.size() == 1 && typed.environment == "smooth-bilinear") {
    refuse("--stiffness", "accepts K1,K2 with --environment smooth-bilinear, got one number");
  }
  const auto predicted = [&](const char* word) {
    return std::find(typed.predictors.begin(), typed.predictors.end(), word) != typed.predictors.end();
  };
  if (predicted("all") && typed.predictors.size() > 1) refuse("--predictor", "accepts all, or a list without it");
  for (const char* option : {"--gain", "--known", "--start"}) {
    if (app.count(option) > 0 && !predicted("all") && !predicted("model")) {
      refuse(option, "goes with --predictor model, which is not asked for");
    }
  }
  std::vector<std::string> outputs;
  for (const std::string& path : {typed.json, typed.csv, typed.plot}) {
    if (path.empty()) continue;
    if (std::any_of(outputs.begin(), outputs.end(), [&](const auto& other) { return is_same_file(path, other); })) {
      refuse("--json, --csv, --plot", "accept different files, got " + path + " twice");
    }
    outputs.push_back(path);
  }
  if (typed.known && !typed.start.empty()) refuse("--start", "accepts nothing with --known: nothing is estimated");
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

Tissue tissue_of(const Typed& typed) {
  static const std::map<std::string, TissueKind> kinds{{"kelvin-voigt", TissueKind::kelvin_voigt},
                                                       {"smooth-bilinear", TissueKind::smooth_bilinear},
                                                       {"hunt-crossley", TissueKind::hunt_crossley}};
  static const std::map<TissueKind, std::vector<double>> stiffness{{TissueKind::kelvin_voigt, {800}},
                                                                   {TissueKind::smooth_bilinear, {370, 1980}},
                                                                   {TissueKind::hunt_crossley, {1500}}};
  Tissue tissue;
  tissue.kind = kinds.at(typed.environment);
  const std::vector<double>& k = typed.stiffness.empty() ? stiffness.at(tissue.kind) : typed.stiffness;
  tissue.stiffness = k.front();
  tissue.stiffness2 = k.back();
  tissue.depth = typed.depth;
  tissue.sharpness = typed.sharpness;
  tissue.exponent = typed.exponent;
  tissue.damping = typed.damping;
  tissue.unilateral = typed.unilateral;
  return tissue;
}

Estimation estimation_of(const Typed& typed, const Tissue& tissue) {
  Estimation estimation;
  estimation.known = typed.known;
  const bool linear = tissue.kind == TissueKind::kelvin_voigt;
  if (!linear) estimation.damping = typed.damping;  // the offset model knows b
  if (typed.start.empty()) return estimation;
  estimation.stiffness = typed.start[0];
  estimation.damping = typed.start[1];
  if (estimation.stiffness < 200 || estimation.stiffness > 2000) {
    refuse("--start", "accepts K in [200, 2000], got " + text(estimation.stiffness));
  }
  if (linear && (estimation.damping < 20 || estimation.damping > 40)) {
    refuse("--start", "accepts B in [20, 40], got " + text(estimation.damping));
  }
  return estimation;
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

std::vector<PredictorKind> predictors_of(const Typed& typed) {
  const auto wanted = [&](const char* word) {
    return std::find(typed.predictors.begin(), typed.predictors.end(), word) != typed.predictors.end();
  };
  std::vector<PredictorKind> predictors;
  for (const PredictorKind kind : {PredictorKind::hold, PredictorKind::model, PredictorKind::ideal}) {
    if (wanted("all") || wanted(name(kind))) predictors.push_back(kind);
  }
  return predictors;
}

Scene scene_of(const CLI::App& app, const Typed& typed) {
  refuse_strangers(app, typed);
  if (typed.gain.size() != 2 && typed.gain.size() != 6) {
    refuse("--gain", "accepts two or six numbers, got " + std::to_string(typed.gain.size()));
  }
  if (typed.tool[0] < 1e-6) refuse("--tool", "accepts a mass of 1e-6 kg or more, got " + text(typed.tool[0]));
  Scene scene;
  scene.tissue = tissue_of(typed);
  scene.estimation = estimation_of(typed, scene.tissue);
  scene.gain = typed.gain;
  scene.tool = {.mass = typed.tool[0], .damping = typed.tool[1], .stiffness = typed.tool[2]};
  scene.force = force_of(app, typed);
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
  scene.robot = typed.robot == "ideal" ? RobotKind::ideal : RobotKind::realistic;
  scene.hand = hand_of(typed);
  scene.playback = typed.playback;
  return scene;
}

}  // namespace

const char* name(PredictorKind kind) {
  switch (kind) {
    case PredictorKind::hold:
      return "hold";
    case PredictorKind::model:
      return "model";
    case PredictorKind::ideal:
      return "ideal";
  }
  return "unknown";
}

PalpateOptions parse_palpate_options(int argc, const char* const* argv) {
  CLI::App app{"A hand presses a simulated Phantom Omni against a slow tissue, with and without prediction.",
               "palpate"};
  Typed typed;
  add_options(app, typed);
  PalpateOptions options;
  try {
    app.parse(argc, argv);
    options.scene = scene_of(app, typed);
  } catch (const CLI::ParseError& error) {
    options.exit_code = app.exit(error);
    return options;
  }
  options.predictors = predictors_of(typed);
  options.json = typed.json;
  options.csv = typed.csv;
  options.plot = typed.plot;
  return options;
}

}  // namespace limpid::examples
