// SPDX-License-Identifier: MIT
#include "palpate_tissue_options.hpp"

#include "option_checks.hpp"
#include "option_values.hpp"

#include <algorithm>
#include <array>

namespace limpid::examples {

namespace {

struct Kind {
  TissueKind kind;
  std::vector<double> stiffness;  // by default; of none that it has
  std::string stiffness_words;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{{TissueKind::kelvin_voigt, {800}, "one number K"},
                                     {TissueKind::smooth_bilinear, {370, 1980}, "K1,K2"},
                                     {TissueKind::hunt_crossley, {1500}, "one number K"},
                                     {TissueKind::exponential, {}, "nothing"},
                                     {TissueKind::layered, {400, 1500, 800}, "K1,K2,K3"}};
  return all;
}

std::vector<std::string> environments() {
  std::vector<std::string> names;
  for (const Kind& each : kinds()) names.emplace_back(name(each.kind));
  return names;
}

void refuse_strangers(const CLI::App& app, const TypedTissue& typed) {
  const auto only_with = [&](const char* option, TissueKind kind) {
    if (app.count(option) > 0 && typed.environment != name(kind)) {
      refuse(option, std::string("goes with --environment ") + name(kind) + ", got " + typed.environment);
    }
  };
  only_with("--depth", TissueKind::smooth_bilinear);
  only_with("--sharpness", TissueKind::smooth_bilinear);
  only_with("--exponent", TissueKind::hunt_crossley);
  only_with("--amplitude", TissueKind::exponential);
  only_with("--growth", TissueKind::exponential);
  only_with("--boundaries", TissueKind::layered);
}

std::vector<double> stiffness_of(const Kind& kind, const TypedTissue& typed) {
  const std::size_t count = typed.stiffness.size();
  if (count == 0) return kind.stiffness;
  if (count != kind.stiffness.size()) {
    static const std::array<const char*, 4> got{"nothing", "one number", "two numbers", "three numbers"};
    refuse("--stiffness", kind.stiffness_words + " with --environment " + typed.environment, got.at(count));
  }
  return typed.stiffness;
}

}  // namespace

void add_tissue_options(CLI::App& app, TypedTissue& typed) {
  const auto positive = within(0, 1e6, true), not_negative = within(0, 1e6);
  app.add_option("--environment", typed.environment, "the tissue")->check(CLI::IsMember(environments()));
  app.add_option("--stiffness", typed.stiffness, "K, N/m; K1,K2 for smooth-bilinear; K1,K2,K3 for layered")
      ->delimiter(',')
      ->expected(1, 3)
      ->check(not_negative);
  app.add_option("--depth", typed.depth, "XS of smooth-bilinear, m")->check(positive);
  app.add_option("--sharpness", typed.sharpness, "R of smooth-bilinear")->check(positive);
  app.add_option("--exponent", typed.exponent, "N of hunt-crossley")->check(within(1, 10));
  app.add_option("--amplitude", typed.amplitude, "A of exponential, A (exp(R x) - 1), N")->check(not_negative);
  app.add_option("--growth", typed.growth, "R of exponential, 1/m")->check(positive);
  app.add_option("--boundaries", typed.boundaries, "D1,D2: depths at which layered changes, m")
      ->delimiter(',')
      ->expected(2)
      ->check(positive);
  app.add_option("--damping", typed.damping, "B, N s/m")->check(not_negative);
  app.add_flag("--unilateral", typed.unilateral, "the tool may leave the wall");
  app.add_option("--wall", typed.wall, "DEPTH where the tissue is first touched, m; nothing there pulls, nor the hand")
      ->check(within(0, 1));
}

Tissue tissue_of(const CLI::App& app, const TypedTissue& typed) {
  refuse_strangers(app, typed);
  const auto found =
      std::find_if(kinds().begin(), kinds().end(), [&](const Kind& of) { return typed.environment == name(of.kind); });
  Tissue tissue;
  tissue.kind = found->kind;
  const std::vector<double> k = stiffness_of(*found, typed);
  if (!k.empty()) {
    tissue.stiffness = k.front();
    tissue.stiffness2 = k.back();
  }
  if (tissue.kind == TissueKind::layered) std::copy(k.begin(), k.end(), tissue.layers.begin());
  std::copy(typed.boundaries.begin(), typed.boundaries.end(), tissue.boundaries.begin());
  if (!(tissue.boundaries[0] < tissue.boundaries[1])) {
    refuse("--boundaries", "D1,D2 with D1 < D2", text(tissue.boundaries[0]) + "," + text(tissue.boundaries[1]));
  }
  tissue.depth = typed.depth;
  tissue.sharpness = typed.sharpness;
  tissue.exponent = typed.exponent;
  tissue.amplitude = typed.amplitude;
  tissue.growth = typed.growth;
  tissue.damping = typed.damping;
  tissue.unilateral = typed.unilateral;
  if (app.count("--wall") > 0) tissue.wall = typed.wall;
  return tissue;
}

}  // namespace limpid::examples
