// SPDX-License-Identifier: MIT
#include "palpation_loops.hpp"
#include "palpation_models.hpp"

#include <limpid/prediction/gains.hpp>

namespace limpid::examples {

namespace {

// The scene's gain on the press axis; a constant one is a scheduled one whose L1 and L2 are zero.
template <int Axes>
ScheduledGain<Axes> gain_of(const Scene& scene) {
  using Vector = Eigen::Array<double, Axes, 1>;
  const auto on_press_axis = [](double value) {
    Vector vector = Vector::Zero();
    vector[0] = value;
    return vector;
  };
  const auto row = [&](std::size_t at) {
    if (at + 1 >= scene.gain.size()) return GainRow<Axes>{};
    return GainRow<Axes>{on_press_axis(scene.gain[at]), on_press_axis(scene.gain[at + 1])};
  };
  const bool scheduled = scene.gain.size() > 2;  // within the box of the design, 6.2.1; a constant gain needs none
  return ScheduledGain<Axes>({.L0 = row(0),
                              .L1 = row(2),
                              .L2 = row(4),
                              .lower = {on_press_axis(scheduled ? 200 : -1e12), on_press_axis(scheduled ? 20 : -1e12)},
                              .upper = {on_press_axis(scheduled ? 2000 : 1e12), on_press_axis(scheduled ? 40 : 1e12)}});
}

struct ModelKind {
  template <Environment E, typename Parameters>
  using Predictor = ModelPredictor<E, Tool<EnvironmentTraits<E>::axes>, Parameters,
                                   ScheduledGain<EnvironmentTraits<E>::axes>, prediction_history>;

  template <typename Settings>
  static void complete(Settings& settings, const Scene& scene) {
    settings.gain = gain_of<decltype(settings.start.x)::RowsAtCompileTime>(scene);
  }
};

}  // namespace

PalpationResult palpate_with_model(const Scene& scene, const ProgressCallback& progress) {
  const WithModel<ModelKind> model(scene);
  if (!scene.spring_at_base) return run(scene, model.on_press_axis(), progress);
  const AnyPrediction<3> in_space = scene.estimation.known
                                        ? model.known<KelvinVoigt<3>>({}, true_parameters<3>(scene.tissue))
                                        : model.estimated<KelvinVoigt<3>>(linear_estimation<3>(scene));
  return run(scene, in_space, progress);
}

}  // namespace limpid::examples
