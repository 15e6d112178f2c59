// SPDX-License-Identifier: MIT
#include "palpate_predictor_options.hpp"

#include "option_checks.hpp"
#include "option_values.hpp"

#include <algorithm>
#include <array>

namespace limpid::examples {

namespace {

constexpr std::array all{PredictorKind::hold,           PredictorKind::linear, PredictorKind::quadratic,
                         PredictorKind::autoregressive, PredictorKind::smith,  PredictorKind::model,
                         PredictorKind::replay,         PredictorKind::curve,  PredictorKind::chosen,
                         PredictorKind::ideal};

std::vector<std::string> names() {
  std::vector<std::string> words;
  for (const PredictorKind kind : all) words.emplace_back(name(kind));
  words.emplace_back("all");
  return words;
}

bool asked(const TypedPredictors& typed, const std::string& word) {
  return std::find(typed.names.begin(), typed.names.end(), word) != typed.names.end();
}

void refuse_without(const CLI::App& app, const TypedPredictors& typed, const char* option,
                    const std::vector<std::string>& predictors) {
  if (app.count(option) == 0 || asked(typed, "all")) return;
  if (std::any_of(predictors.begin(), predictors.end(), [&](const auto& each) { return asked(typed, each); })) return;
  std::string words;
  for (const std::string& each : predictors) words += (words.empty() ? "" : " or ") + each;
  refuse(option, "goes with --predictor " + words + ", which is not asked for");
}

}  // namespace

void add_predictor_options(CLI::App& app, TypedPredictors& typed) {
  app.add_option("--predictor", typed.names, "who predicts, a list; default: hold,model,ideal")
      ->delimiter(',')
      ->check(CLI::IsMember(names()));
  app.add_option("--gain", typed.gain, "L1,L2 or six numbers: L0, L1, L2 of a scheduled gain, of model")
      ->delimiter(',')
      ->expected(2, 6)
      ->check(within(-1e6, 1e6));
  app.add_flag("--known", typed.known, "smith, model and replay know the tissue, but not what disturbs it");
  app.add_option("--start", typed.start, "K,B: where the estimate of smith, model and replay starts")
      ->delimiter(',')
      ->expected(2)
      ->check(within(0, 1e6));
}

std::vector<PredictorKind> predictors_of(const CLI::App& app, const TypedPredictors& typed) {
  if (asked(typed, "all") && typed.names.size() > 1) refuse("--predictor", "accepts all, or a list without it");
  refuse_without(app, typed, "--gain", {"model"});
  refuse_without(app, typed, "--known", {"model", "replay", "smith"});
  refuse_without(app, typed, "--start", {"model", "replay", "smith"});
  if (typed.gain.size() != 2 && typed.gain.size() != 6) {
    refuse("--gain", "accepts two or six numbers, got " + std::to_string(typed.gain.size()));
  }
  if (typed.known && !typed.start.empty()) refuse("--start", "accepts nothing with --known: nothing is estimated");
  std::vector<PredictorKind> predictors;
  for (const PredictorKind kind : all) {
    if (asked(typed, "all") || asked(typed, name(kind))) predictors.push_back(kind);
  }
  return predictors;
}

Estimation estimation_of(const TypedPredictors& typed, const Tissue& tissue) {
  Estimation estimation;
  estimation.known = typed.known;
  const bool linear = estimates_damping(tissue);
  if (!linear) estimation.damping = tissue.damping;  // the offset model knows b
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

void refuse_unserved(const std::vector<PredictorKind>& predictors, const Scene& scene) {
  constexpr int most = 500;  // of the ticks that these remember
  for (const PredictorKind kind : {PredictorKind::curve, PredictorKind::chosen}) {
    if (std::find(predictors.begin(), predictors.end(), kind) == predictors.end()) continue;
    const std::string with = std::string(" with --predictor ") + name(kind);
    if (scene.tool.stiffness > 0) refuse("--tool", "a spring of 0 N/m" + with, text(scene.tool.stiffness));
    const Duration needed = scene.delay + scene.period;
    if (needed > most * scene.tick) {
      refuse(
          "--sample-period, --delay",
          "at most " + std::to_string(most) + " ticks, " + text(in_seconds(most * scene.tick)) + " s, together" + with,
          text(in_seconds(needed)) + " s");
    }
  }
}

}  // namespace limpid::examples
