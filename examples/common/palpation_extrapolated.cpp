// SPDX-License-Identifier: MIT
// What extrapolates the samples, and hold.
#include "any_prediction.hpp"
#include "palpation_loops.hpp"

#include <limpid/prediction/autoregressive_predictor.hpp>
#include <limpid/prediction/hold_predictor.hpp>
#include <limpid/prediction/linear_predictor.hpp>
#include <limpid/prediction/quadratic_predictor.hpp>

#include <stdexcept>

namespace limpid::examples {

namespace {

AnyPrediction<1> extrapolation(const Scene& scene, PredictorKind predictor) {
  switch (predictor) {
    case PredictorKind::hold:
      return predicting(std::make_shared<HoldPredictor<1>>());
    case PredictorKind::linear:
      return predicting(std::make_shared<LinearPredictor<1>>());
    case PredictorKind::quadratic:
      return predicting(
          std::make_shared<QuadraticPredictor<1>>(QuadraticPredictor<1>::Settings{.tool = tool_of<1>(scene)}));
    case PredictorKind::autoregressive:
      return predicting(
          std::make_shared<AutoregressivePredictor<2>>(AutoregressivePredictor<2>::Settings{.period = scene.period}));
    default:
      throw std::invalid_argument("palpate: unknown extrapolation");
  }
}

}  // namespace

PalpationResult palpate_with_extrapolation(const Scene& scene, PredictorKind predictor,
                                           const ProgressCallback& progress) {
  if (!scene.spring_at_base) return run(scene, extrapolation(scene, predictor), progress);
  return run(scene, predicting(std::make_shared<HoldPredictor<3>>()), progress);
}

}  // namespace limpid::examples
