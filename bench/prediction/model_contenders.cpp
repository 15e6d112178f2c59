// SPDX-License-Identifier: MIT
// The thesis's model of a nonlinear tissue, with b = 30 N s/m known.
#include "prediction/contenders.hpp"
#include "prediction/drive.hpp"

#include <common/offset_model.hpp>

#include <limpid/prediction/model_predictor.hpp>
#include <limpid/prediction/replay_predictor.hpp>
#include <limpid/prediction/smith_predictor.hpp>

namespace limpid::bench {

namespace {

using examples::OffsetModel;
constexpr std::size_t history = 4096;  // ticks

template <typename P>
Trace with_estimate(const Course& course) {
  const auto settings = examples::offset_estimation(1100, 30);
  EnvironmentEstimator<OffsetModel> estimator(settings);
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
