// SPDX-License-Identifier: MIT
#include "palpation_tissue.hpp"

#include <limpid/environment/exponential.hpp>
#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/layered.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/unilateral.hpp>

#include <stdexcept>

namespace limpid::examples {

namespace {

using One = TissueModel::Vector;

template <Environment E>
TissueModel with_parameters(const E& environment, const EnvironmentTheta<E>& theta) {
  return TissueModel(
      [environment, theta](const One& x, const One& v) { return response_of(environment, theta, x, v); });
}

// Touched at the surface, from both sides.
TissueModel bilateral(const Tissue& tissue) {
  switch (tissue.kind) {
    case TissueKind::kelvin_voigt:
      return with_parameters(KelvinVoigt<1>{}, {tissue.stiffness, tissue.damping});
    case TissueKind::smooth_bilinear:
      return with_parameters(SmoothBilinear<1>({.depth = tissue.depth, .sharpness = tissue.sharpness}),
                             {tissue.stiffness, tissue.stiffness2, tissue.damping});
    case TissueKind::hunt_crossley:
      return with_parameters(HuntCrossley<1>({.exponent = tissue.exponent}), {tissue.stiffness, 0, tissue.damping});
    case TissueKind::exponential:
      return with_parameters(Exponential<1>({.growth = tissue.growth}), {tissue.amplitude, tissue.damping});
    case TissueKind::layered:
      return with_parameters(Layered<3>({.depths = tissue.boundaries}),
                             {tissue.layers[0], tissue.layers[1], tissue.layers[2], tissue.damping});
  }
  throw std::invalid_argument("Scene: tissue: unknown kind");
}

}  // namespace

bool is_linear(const Tissue& tissue) {
  return tissue.kind == TissueKind::kelvin_voigt && !tissue.unilateral && !tissue.wall;
}

TissueModel model_of(const Tissue& tissue) {
  TissueModel model = bilateral(tissue);
  if (tissue.unilateral || tissue.wall) {
    model = with_parameters(Unilateral<TissueModel>({.environment = model}), One::Ones());
  }
  if (!tissue.wall) return model;
  return TissueModel([inner = model, wall = *tissue.wall](const One& x, const One& v) {
    return inner.response(One::Ones(), x - wall, v);
  });
}

UndisturbedForce undisturbed_force(const Tissue& tissue) {
  const double begin = tissue.wall.value_or(0);
  const auto elastic = [model = bilateral(tissue), begin](double x) {
    return model.force(One::Ones(), One(x - begin), One::Zero())[0];
  };
  const bool from_one_side = tissue.unilateral || tissue.wall;
  return {elastic, tissue.damping, from_one_side ? std::optional(begin) : std::nullopt};
}

}  // namespace limpid::examples
