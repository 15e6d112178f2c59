// SPDX-License-Identifier: MIT
// What learns a whole force law.
#include "any_prediction.hpp"
#include "palpation_loops.hpp"

#include <limpid/prediction/tissue_predictor.hpp>

#include <memory>

namespace limpid::examples {

PalpationResult palpate_with_learning(const Scene& scene, PredictorKind predictor, const ProgressCallback& progress) {
  const Tool<1> tool = tool_of<1>(scene);
  const TissuePredictorSettings<> settings{.mass = tool.mass, .tool_damping = tool.damping, .period = scene.period};
  if (predictor == PredictorKind::curve) {
    return run(scene, predicting(std::make_shared<CurvePredictor<>>(curve_settings(settings, true, false))), progress);
  }
  return run(scene, predicting(std::shared_ptr<TissuePredictor<>>(make_tissue_predictor(settings))), progress);
}

}  // namespace limpid::examples
