// SPDX-License-Identifier: MIT
// Model prediction where the tissue is known: the loops carry no estimator.
#include "model_loops.hpp"
#include "palpation_loops.hpp"

#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/smooth_bilinear.hpp>

namespace limpid::examples {

namespace {

template <Environment E>
PalpationResult known(const Scene& scene, const E& environment, const EnvironmentTheta<E>& theta,
                      const ProgressCallback& progress) {
  constexpr int axes = EnvironmentTraits<E>::axes;
  using Predictor = ModelPredictor<E, Tool<axes>, Known, ScheduledGain<axes>, prediction_history>;
  const Predictor predictor(
      {.environment = environment, .tool = tool_of<axes>(scene), .theta = theta, .gain = gain_of<axes>(scene)});
  return run<axes>(
      scene, compose<axes>(scene, palpation::PredictionBlock<Predictor, axes>{predictor}),
      [](const auto&) -> Eigen::Array2d { return Eigen::Array2d::Zero(); }, progress);
}

template <Environment E>
PalpationResult with_contact(const Scene& scene, const E& environment, const EnvironmentTheta<E>& theta,
                             const ProgressCallback& progress) {
  if (!scene.tissue.unilateral) return known(scene, environment, theta, progress);
  return known(scene, Unilateral<E>({.environment = environment}), theta, progress);
}

}  // namespace

PalpationResult palpate_with_known_model(const Scene& scene, const ProgressCallback& progress) {
  const Tissue& tissue = scene.tissue;
  if (scene.spring_at_base) {
    EnvironmentTheta<KelvinVoigt<3>> theta = EnvironmentTheta<KelvinVoigt<3>>::Zero();
    theta.row(0) << tissue.stiffness, tissue.damping;
    return known(scene, KelvinVoigt<3>{}, theta, progress);
  }
  switch (tissue.kind) {
    case TissueKind::smooth_bilinear:
      return with_contact(scene, SmoothBilinear<1>({.depth = tissue.depth, .sharpness = tissue.sharpness}),
                          {tissue.stiffness, tissue.stiffness2, tissue.damping}, progress);
    case TissueKind::hunt_crossley:
      return with_contact(scene, HuntCrossley<1>({.exponent = tissue.exponent}), {tissue.stiffness, 0, tissue.damping},
                          progress);
    case TissueKind::kelvin_voigt:
      break;
  }
  return with_contact(scene, KelvinVoigt<1>{}, {tissue.stiffness, tissue.damping}, progress);
}

}  // namespace limpid::examples
