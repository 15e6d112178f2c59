// SPDX-License-Identifier: MIT
// What predictors with a model of the tissue have in common; included by their sources.
#pragma once

#include "any_prediction.hpp"
#include "offset_model.hpp"
#include "palpation_tissue.hpp"

#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/unilateral.hpp>
#include <limpid/prediction/model_predictor.hpp>

namespace limpid::examples {

/// Ticks that a predictor remembers: samples up to 4 s old at 1 kHz find their own prediction.
inline constexpr std::size_t prediction_history = 4096;

/// Section 6.1.3. Axes other than the press axis have no tissue: their box is the point zero.
template <int Axes>
[[nodiscard]] typename EnvironmentEstimator<KelvinVoigt<Axes>>::Settings linear_estimation(const Scene& scene) {
  typename EnvironmentEstimator<KelvinVoigt<Axes>>::Settings settings;
  auto& law = settings.law;
  law.lower.setZero();
  law.upper.setZero();
  law.initial.setZero();
  law.initial_gain.setOnes();
  law.lower.row(0) << 200, scene.estimation.least_damping;
  law.upper.row(0) << 2000, 40;
  law.initial.row(0) << scene.estimation.stiffness, scene.estimation.damping;
  law.initial_gain.row(0) << 1e9, scene.estimation.damping_gain;
  law.forgetting = scene.estimation.forgetting.value_or(2);
  return settings;
}

/// Section 6.2.2.
[[nodiscard]] inline EnvironmentEstimator<OffsetModel>::Settings offset_estimation(const Scene& scene) {
  auto settings = offset_estimation(scene.estimation.stiffness, scene.estimation.damping);
  settings.law.lower[1] = scene.estimation.least_offset;
  settings.law.forgetting = scene.estimation.forgetting.value_or(settings.law.forgetting);
  return settings;
}

/// The press axis of `KelvinVoigt<Axes>`; the others have no tissue.
template <int Axes>
[[nodiscard]] EnvironmentTheta<KelvinVoigt<Axes>> true_parameters(const Tissue& tissue) {
  EnvironmentTheta<KelvinVoigt<Axes>> theta = EnvironmentTheta<KelvinVoigt<Axes>>::Zero();
  theta.row(0) << tissue.stiffness, tissue.damping;
  return theta;
}

/// Predictors of a kind, `Kind::Predictor<E, Known>` or `Kind::Predictor<E, Estimated>`, by their environment E;
/// `Kind::complete`, where there is one, sets what only they have.
template <typename Kind>
class WithModel {
 public:
  explicit WithModel(const Scene& scene) : scene_{scene} {}

  template <Environment E>
  [[nodiscard]] auto known(const E& environment, const EnvironmentTheta<E>& theta) const {
    using P = typename Kind::template Predictor<E, Known>;
    return predicting(std::make_shared<P>(predictor<P, E>(environment, theta)));
  }

  template <Environment E>
  [[nodiscard]] auto estimated(const typename EnvironmentEstimator<E>::Settings& settings) const {
    using P = typename Kind::template Predictor<E, Estimated>;
    return predicting(EnvironmentEstimator<E>(settings), predictor<P, E>(settings.environment, settings.law.initial));
  }

  /// On the press axis: the true tissue, or estimated (k, b) of a linear one, (k, c) of a nonlinear one with b
  /// known, or (k, b) where the scene says so.
  [[nodiscard]] AnyPrediction<1> on_press_axis() const {
    const Tissue& tissue = scene_.tissue;
    if (scene_.estimation.known) {
      return is_linear(tissue) ? known<KelvinVoigt<1>>({}, true_parameters<1>(tissue))
                               : known<TissueModel>(model_of(tissue), TissueModel::Theta::Ones());
    }
    if (estimates_damping(tissue) || scene_.estimation.linear) {
      return with_contact<KelvinVoigt<1>>(linear_estimation<1>(scene_));
    }
    return with_contact<OffsetModel>(offset_estimation(scene_));
  }

 private:
  template <typename P, Environment E>
  [[nodiscard]] P predictor(const E& environment, const EnvironmentTheta<E>& theta) const {
    constexpr int axes = EnvironmentTraits<E>::axes;
    typename P::Settings settings{.environment = environment, .tool = tool_of<axes>(scene_), .theta = theta};
    if constexpr (requires { Kind::complete(settings, scene_); }) Kind::complete(settings, scene_);
    return P(settings);
  }

  template <Environment E>
  [[nodiscard]] AnyPrediction<1> with_contact(const typename EnvironmentEstimator<E>::Settings& settings) const {
    if (!scene_.tissue.unilateral) return estimated<E>(settings);
    return estimated<Unilateral<E>>(
        {.environment = Unilateral<E>({.environment = settings.environment}), .law = settings.law});
  }

  const Scene& scene_;
};

}  // namespace limpid::examples
