// SPDX-License-Identifier: MIT
#pragma once

#include "palpation_run.hpp"

#include <functional>
#include <memory>
#include <utility>

namespace limpid::examples {

/// Who predicts, whatever its type: one loop is compiled for all.
template <int Axes>
struct AnyPrediction {
  /// The tool at `now` from what is seen of it and the operator's force at `now`, N.
  std::function<Prediction<Axes>(Time now, const Held<ToolState<Axes>>& seen, const Eigen::Vector3d& F_h)> advance;
  std::function<Eigen::Array2d()> parameters = [] { return Eigen::Array2d(Eigen::Array2d::Zero()); };  ///< estimated
};

/// A predictor that needs no estimate.
template <typename P>
[[nodiscard]] AnyPrediction<P::axes> predicting(std::shared_ptr<P> predictor) {
  constexpr int axes = P::axes;
  AnyPrediction<axes> any;
  any.advance = [predictor](Time now, const Held<ToolState<axes>>& seen, const Eigen::Vector3d& F_h) {
    return palpation::observe_and_advance<P, axes>(*predictor, now, seen, F_h);
  };
  return any;
}

/// A predictor whose model is estimated as the loop runs.
template <Environment E, typename P>
[[nodiscard]] AnyPrediction<P::axes> predicting(const EnvironmentEstimator<E>& estimator, const P& predictor) {
  constexpr int axes = P::axes;
  struct Blocks {
    palpation::AdaptationBlock<E> adapt;
    palpation::AdaptivePredictionBlock<P, E> predict;
  };
  const auto blocks = std::make_shared<Blocks>(Blocks{{estimator}, {predictor}});
  AnyPrediction<axes> any;
  any.advance = [blocks](Time now, const Held<ToolState<axes>>& seen, const Eigen::Vector3d& F_h) {
    const auto [estimate, status] = blocks->adapt(now, seen);
    Prediction<axes> predicted = blocks->predict(now, seen, estimate, F_h);
    predicted.status |= status;
    return predicted;
  };
  any.parameters = [blocks]() -> Eigen::Array2d {
    return blocks->adapt.component.estimate().theta_hat.row(0).transpose();
  };
  return any;
}

/// Runs the loop in which it predicts.
[[nodiscard]] PalpationResult run(const Scene& scene, const AnyPrediction<1>& prediction,
                                  const ProgressCallback& progress);
[[nodiscard]] PalpationResult run(const Scene& scene, const AnyPrediction<3>& prediction,
                                  const ProgressCallback& progress);

}  // namespace limpid::examples
