// SPDX-License-Identifier: MIT
#include "palpation_loops.hpp"
#include "palpation_models.hpp"

#include <limpid/prediction/replay_predictor.hpp>

namespace limpid::examples {

namespace {

struct ReplayKind {
  template <Environment E, typename Parameters>
  using Predictor = ReplayPredictor<E, Tool<1>, Parameters, prediction_history>;
};

}  // namespace

PalpationResult palpate_with_replay(const Scene& scene, const ProgressCallback& progress) {
  return run(scene, WithModel<ReplayKind>(scene).on_press_axis(), progress);
}

}  // namespace limpid::examples
