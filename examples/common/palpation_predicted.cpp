// SPDX-License-Identifier: MIT
// The loop of any predictor.
#include "any_prediction.hpp"

namespace limpid::examples {

namespace {

template <int Axes>
struct AnyPredictionBlock {
  using reads = signals<palpation::SeenTool<Axes>, palpation::OperatorForce<>>;
  using writes = signals<palpation::PredictedMotion<Axes>>;

  AnyPrediction<Axes> component;

  Prediction<Axes> operator()(Time now, const Held<ToolState<Axes>>& seen, const Eigen::Vector3d& F_h) noexcept {
    return component.advance(now, seen, F_h);
  }
};

template <int Axes>
PalpationResult predicted(const Scene& scene, const AnyPrediction<Axes>& prediction, const ProgressCallback& progress) {
  return run<Axes>(
      scene, compose<Axes>(scene, AnyPredictionBlock<Axes>{prediction}),
      [parameters = prediction.parameters](const auto&) -> Eigen::Array2d { return parameters(); }, progress);
}

}  // namespace

PalpationResult run(const Scene& scene, const AnyPrediction<1>& prediction, const ProgressCallback& progress) {
  return predicted(scene, prediction, progress);
}

PalpationResult run(const Scene& scene, const AnyPrediction<3>& prediction, const ProgressCallback& progress) {
  return predicted(scene, prediction, progress);
}

}  // namespace limpid::examples
