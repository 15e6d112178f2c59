// SPDX-License-Identifier: MIT
#include "palpation_live.hpp"
#include "palpation_loops.hpp"

#include <stdexcept>
#include <string>

namespace limpid::examples {

namespace {

void check_live(const Scene& scene) {
  if (scene.hand) throw std::invalid_argument("Scene: hand: expected none in a live run, which has one or plays it");
  if (scene.spring_at_base) throw std::invalid_argument("Scene: spring_at_base: expected none in a live run");
  if (scene.disturbances.sensing.any()) {
    throw std::invalid_argument("Scene: disturbances of samples: expected none in a live run");
  }
}

}  // namespace

PalpationResult palpate(const Scene& asked, PredictorKind predictor, const ProgressCallback& progress) {
  Scene scene = asked;
  if (scene.live) {
    check_live(scene);
    prepare_live(scene);
  }
  if (scene.hand && scene.playback) {
    throw std::invalid_argument("Scene: hand: expected none with playback, in which nothing holds the arm");
  }
  switch (predictor) {
    case PredictorKind::ideal:
      return palpate_with_ideal_signal(scene, progress);
    case PredictorKind::model:
      return palpate_with_model(scene, progress);
    case PredictorKind::hold:
      return palpate_with_extrapolation(scene, predictor, progress);
    default:
      break;
  }
  if (scene.spring_at_base) {
    throw std::invalid_argument(std::string("Scene: spring_at_base: expected hold, model or ideal, got ") +
                                name(predictor));
  }
  switch (predictor) {
    case PredictorKind::replay:
      return palpate_with_replay(scene, progress);
    case PredictorKind::smith:
      return palpate_with_smith(scene, progress);
    case PredictorKind::curve:
    case PredictorKind::chosen:
      return palpate_with_learning(scene, predictor, progress);
    default:
      return palpate_with_extrapolation(scene, predictor, progress);
  }
}

}  // namespace limpid::examples
