// SPDX-License-Identifier: MIT
// The thesis's model of a nonlinear tissue (6.2.2), F_e = k x + c + b v with k and c estimated and b = 30 N s/m known.
#include "prediction/contenders.hpp"
#include "prediction/drive.hpp"

#include <limpid/environment/fixed.hpp>
#include <limpid/environment/tangent_model.hpp>
#include <limpid/estimation/environment_estimator.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <limpid/prediction/replay_predictor.hpp>
#include <limpid/prediction/smith_predictor.hpp>

namespace limpid::bench {

namespace {

using OffsetModel = Fixed<Tangent<1>, 1>;
using Estimator = EnvironmentEstimator<OffsetModel>;
constexpr std::size_t history = 4096;  // ticks

Estimator::Settings estimation() {
  Estimator::Settings settings{.environment = OffsetModel({.known = OffsetModel::Values(30)}), .law = {}};
  settings.law.lower << 200, -55;
  settings.law.upper << 2000, 0;
  settings.law.initial << 1100, 0;
  settings.law.initial_gain << 1e9, 1e4;
  settings.law.forgetting = 20;
  return settings;
}

template <typename P>
Trace with_estimate(const Course& course) {
  const Estimator::Settings settings = estimation();
  Estimator estimator(settings);
  P predictor({.environment = settings.environment, .tool = tool(), .theta = settings.law.initial});
  return drive(predictor, course, [&](Time now, const Held<ToolState<1>>& held) {
    (void)estimator.update(now, held);
    (void)predictor.use(estimator.estimate());
  });
}

}  // namespace

// The gain L of `model` is zero.
std::vector<Contender> model_contenders() {
  return {{"smith", with_estimate<SmithPredictor<OffsetModel, Tool<1>, Estimated, history>>},
          {"model", with_estimate<ModelPredictor<OffsetModel, Tool<1>, Estimated, ConstantGain<1>, history>>},
          {"replay", with_estimate<ReplayPredictor<OffsetModel, Tool<1>, Estimated, history>>}};
}

}  // namespace limpid::bench
