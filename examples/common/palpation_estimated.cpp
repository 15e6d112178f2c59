// SPDX-License-Identifier: MIT
// Model prediction where the tissue is estimated: (k, b) of a linear one; of a nonlinear one (k, c), with b known.
#include "model_loops.hpp"
#include "palpation_loops.hpp"

namespace limpid::examples {

namespace {

template <Environment E>
using EstimatorSettings = typename EnvironmentEstimator<E>::Settings;

// Section 6.1.3. Axes other than the press axis have no tissue: their box is the point zero.
template <int Axes>
EstimatorSettings<KelvinVoigt<Axes>> linear_estimation(const Scene& scene) {
  EstimatorSettings<KelvinVoigt<Axes>> settings;
  auto& law = settings.law;
  law.lower.setZero();
  law.upper.setZero();
  law.initial.setZero();
  law.initial_gain.setOnes();
  law.lower.row(0) << 200, 20;
  law.upper.row(0) << 2000, 40;
  law.initial.row(0) << scene.estimation.stiffness, scene.estimation.damping;
  law.initial_gain.row(0) << 1e9, 8e6;
  law.forgetting = 2;
  return settings;
}

using OffsetModel = Fixed<Tangent<1>, 1>;

OffsetModel offset_model(const Scene& scene) {
  return OffsetModel({.known = OffsetModel::Values(scene.estimation.damping)});
}

// Section 6.2.2.
EstimatorSettings<OffsetModel> offset_estimation(const Scene& scene) {
  EstimatorSettings<OffsetModel> settings{.environment = offset_model(scene), .law = {}};
  settings.law.lower << 200, -55;
  settings.law.upper << 2000, 0;
  settings.law.initial << scene.estimation.stiffness, 0;
  settings.law.initial_gain << 1e9, 1e4;
  settings.law.forgetting = 20;
  return settings;
}

template <Environment E>
PalpationResult estimated(const Scene& scene, const EstimatorSettings<E>& settings, const ProgressCallback& progress) {
  constexpr int axes = EnvironmentTraits<E>::axes;
  using Predictor = ModelPredictor<E, Tool<axes>, Estimated, ScheduledGain<axes>, prediction_history>;
  const EnvironmentEstimator<E> estimator(settings);
  const Predictor predictor({.environment = settings.environment,
                             .tool = tool_of<axes>(scene),
                             .theta = settings.law.initial,
                             .gain = gain_of<axes>(scene)});
  using Adaptation = palpation::AdaptationBlock<E>;
  return run<axes>(
      scene, compose<axes>(scene, Adaptation{estimator}, palpation::AdaptivePredictionBlock<Predictor, E>{predictor}),
      [](const auto& loop) -> Eigen::Array2d {
        return loop.template block<Adaptation>().component.estimate().theta_hat.row(0).transpose();
      },
      progress);
}

template <Environment E>
PalpationResult with_contact(const Scene& scene, const EstimatorSettings<E>& settings,
                             const ProgressCallback& progress) {
  if (!scene.tissue.unilateral) return estimated<E>(scene, settings, progress);
  return estimated<Unilateral<E>>(
      scene, {.environment = Unilateral<E>({.environment = settings.environment}), .law = settings.law}, progress);
}

}  // namespace

PalpationResult palpate_with_estimated_model(const Scene& scene, const ProgressCallback& progress) {
  if (scene.spring_at_base) return estimated<KelvinVoigt<3>>(scene, linear_estimation<3>(scene), progress);
  if (scene.tissue.kind == TissueKind::kelvin_voigt) {
    return with_contact<KelvinVoigt<1>>(scene, linear_estimation<1>(scene), progress);
  }
  return with_contact<OffsetModel>(scene, offset_estimation(scene), progress);
}

}  // namespace limpid::examples
