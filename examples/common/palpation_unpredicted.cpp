// SPDX-License-Identifier: MIT
// The two ends of the scale: the sampled signal held, and the true one.
#include "palpation_loops.hpp"
#include "palpation_run.hpp"

#include <limpid/prediction/hold_predictor.hpp>

namespace limpid::examples {

namespace {

template <int Axes>
struct IdealSignal {
  using reads = signals<palpation::TrueTool<Axes>>;
  using writes = signals<palpation::PredictedMotion<Axes>>;

  Prediction<Axes> operator()(Time, const ToolState<Axes>& tool) noexcept { return {{tool.x, tool.v, tool.a}}; }
};

constexpr auto nothing_estimated = [](const auto&) -> Eigen::Array2d { return Eigen::Array2d::Zero(); };

template <int Axes>
PalpationResult held(const Scene& scene, const ProgressCallback& progress) {
  return run<Axes>(scene, compose<Axes>(scene, palpation::PredictionBlock<HoldPredictor<Axes>, Axes>{}),
                   nothing_estimated, progress);
}

template <int Axes>
PalpationResult ideal(const Scene& scene, const ProgressCallback& progress) {
  return run<Axes>(scene, compose<Axes>(scene, IdealSignal<Axes>{}), nothing_estimated, progress);
}

}  // namespace

PalpationResult palpate_with_hold(const Scene& scene, const ProgressCallback& progress) {
  return scene.spring_at_base ? held<3>(scene, progress) : held<1>(scene, progress);
}

PalpationResult palpate_with_ideal_signal(const Scene& scene, const ProgressCallback& progress) {
  return scene.spring_at_base ? ideal<3>(scene, progress) : ideal<1>(scene, progress);
}

}  // namespace limpid::examples
