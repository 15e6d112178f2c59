// SPDX-License-Identifier: MIT
#include "palpation_loops.hpp"
#include "palpation_models.hpp"

#include <limpid/prediction/smith_predictor.hpp>

namespace limpid::examples {

namespace {

struct SmithKind {
  template <Environment E, typename Parameters>
  using Predictor = SmithPredictor<E, Tool<1>, Parameters, prediction_history>;
};

}  // namespace

PalpationResult palpate_with_smith(const Scene& scene, const ProgressCallback& progress) {
  return run(scene, WithModel<SmithKind>(scene).on_press_axis(), progress);
}

}  // namespace limpid::examples
