// SPDX-License-Identifier: MIT
#include "scene.hpp"

namespace limpid::examples {

const char* name(TissueKind kind) {
  switch (kind) {
    case TissueKind::kelvin_voigt:
      return "kelvin-voigt";
    case TissueKind::smooth_bilinear:
      return "smooth-bilinear";
    case TissueKind::hunt_crossley:
      return "hunt-crossley";
    case TissueKind::exponential:
      return "exponential";
    case TissueKind::layered:
      return "layered";
  }
  return "unknown";
}

const char* name(PredictorKind kind) {
  switch (kind) {
    case PredictorKind::hold:
      return "hold";
    case PredictorKind::model:
      return "model";
    case PredictorKind::ideal:
      return "ideal";
    case PredictorKind::linear:
      return "linear";
    case PredictorKind::quadratic:
      return "quadratic";
    case PredictorKind::autoregressive:
      return "autoregressive";
    case PredictorKind::smith:
      return "smith";
    case PredictorKind::replay:
      return "replay";
    case PredictorKind::curve:
      return "curve";
    case PredictorKind::chosen:
      return "chosen";
  }
  return "unknown";
}

}  // namespace limpid::examples
