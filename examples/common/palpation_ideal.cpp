// SPDX-License-Identifier: MIT
// The true signal, as if it were there without sampling or delay.
#include "palpation_loops.hpp"
#include "palpation_run.hpp"

namespace limpid::examples {

namespace {

template <int Axes>
struct IdealSignal {
  using reads = signals<palpation::TrueTool<Axes>>;
  using writes = signals<palpation::PredictedMotion<Axes>>;

  Prediction<Axes> operator()(Time, const ToolState<Axes>& tool) noexcept { return {{tool.x, tool.v, tool.a}}; }
};

template <int Axes>
PalpationResult ideal(const Scene& scene, const ProgressCallback& progress) {
  return run<Axes>(
      scene, compose<Axes>(scene, IdealSignal<Axes>{}),
      [](const auto&) -> Eigen::Array2d { return Eigen::Array2d::Zero(); }, progress);
}

}  // namespace

PalpationResult palpate_with_ideal_signal(const Scene& scene, const ProgressCallback& progress) {
  return scene.spring_at_base ? ideal<3>(scene, progress) : ideal<1>(scene, progress);
}

}  // namespace limpid::examples
