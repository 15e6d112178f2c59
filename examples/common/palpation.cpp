// SPDX-License-Identifier: MIT
#include "palpation_loops.hpp"
#include "palpation_run.hpp"

#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/unilateral.hpp>
#include <limpid/environment/virtual_tool.hpp>

#include <memory>
#include <stdexcept>

namespace limpid::examples {

namespace {

using Theta9 = Omni<>::Parameters;

// Ideal: the reading of 6.1.4 that comes closest to print, Table 5.2 over 1.1 without friction; the controller starts
// from 1.1 times that. Realistic: Table 5.2 with its friction, which the controller starts from.
Theta9 plant_parameters(const Scene& scene) {
  Theta9 theta = Omni<>::table_5_2();
  if (scene.robot == RobotKind::realistic) return theta;
  theta.tail<3>().setZero();
  return theta / 1.1;
}

Theta9 first_estimate(const Scene& scene) {
  return scene.robot == RobotKind::realistic ? Omni<>::table_5_2() : Theta9(1.1 * plant_parameters(scene));
}

ToolState<3> in_space(const ToolState<3>& tool) { return tool; }

ToolState<3> in_space(const ToolState<1>& tool) {
  return {{tool.x[0], 0, 0}, {tool.v[0], 0, 0}, {tool.a[0], 0, 0}, {tool.force[0], 0, 0}};
}

template <Environment E>
Plant plant_of(const Scene& scene, const E& environment, const EnvironmentTheta<E>& theta) {
  constexpr int axes = EnvironmentTraits<E>::axes;
  using Simulated = VirtualTool<E>;
  const auto tool = std::make_shared<Simulated>(
      typename Simulated::Settings{.environment = environment, .theta = theta, .tool = tool_of<axes>(scene)});
  return [tool](Time now, double force) {
    typename Simulated::Vector F_h = Simulated::Vector::Zero();
    F_h[0] = force;
    const auto [state, status] = tool->advance(now, F_h);
    if (status != Status::ok) {
      throw std::runtime_error(
          "--tool, --stiffness, --damping, --force: the tool's motion is too fast to be integrated (" +
          describe(status) + ")");
    }
    return in_space(state);
  };
}

template <Environment E>
Plant with_contact(const Scene& scene, const E& environment, const EnvironmentTheta<E>& theta) {
  if (!scene.tissue.unilateral) return plant_of(scene, environment, theta);
  return plant_of(scene, Unilateral<E>({.environment = environment}), theta);
}

}  // namespace

Plant make_plant(const Scene& scene) {
  const Tissue& tissue = scene.tissue;
  if (scene.spring_at_base) {
    if (tissue.kind != TissueKind::kelvin_voigt || tissue.unilateral) {
      throw std::invalid_argument("Scene: spring_at_base: expected a bilateral kelvin_voigt tissue");
    }
    EnvironmentTheta<KelvinVoigt<3>> theta = EnvironmentTheta<KelvinVoigt<3>>::Zero();
    theta.row(0) << tissue.stiffness, tissue.damping;
    return plant_of(scene, KelvinVoigt<3>{}, theta);
  }
  switch (tissue.kind) {
    case TissueKind::kelvin_voigt:
      return with_contact(scene, KelvinVoigt<1>{}, {tissue.stiffness, tissue.damping});
    case TissueKind::smooth_bilinear:
      return with_contact(scene, SmoothBilinear<1>({.depth = tissue.depth, .sharpness = tissue.sharpness}),
                          {tissue.stiffness, tissue.stiffness2, tissue.damping});
    case TissueKind::hunt_crossley:
      return with_contact(scene, HuntCrossley<1>({.exponent = tissue.exponent}), {tissue.stiffness, 0, tissue.damping});
  }
  throw std::invalid_argument("Scene: tissue: unknown kind");
}

Eigen::Vector3d wall_of(const Scene& scene) { return Omni<>{}.at(scene.start).position(); }

SimulatedOmni<> make_device(const Scene& scene) {
  return SimulatedOmni<>({.theta = plant_parameters(scene),
                          .q0 = scene.start,
                          .realism = scene.robot == RobotKind::ideal ? Realism::ideal : Realism::realistic,
                          .coupling = scene.playback ? OperatorCoupling::playback : OperatorCoupling::on_arm});
}

// Gains (5.6), (5.7).
SlotineLiAdaptive<Omni<>> make_controller(const Scene& scene) {
  Theta9 Gamma;
  Gamma << 0.01, 0.002, 0.002, 0.0005, 0.001, 0.001, 0.02, 0.02, 0.02;
  return SlotineLiAdaptive<Omni<>>(
      {.Lambda = {2.8, 3.0, 1.5}, .Kd = {0.4, 0.28, 0.10}, .Gamma = Gamma, .theta0 = first_estimate(scene)});
}

// An ideal arm stands any torque, as the thesis's simulations do; its limiter still watches joints and workspace.
SafetyLimiter<Omni<>> make_limiter(const Scene& scene) {
  SafetyLimiter<Omni<>>::Settings settings;
  if (scene.robot == RobotKind::ideal) {
    settings.torque_limit = Eigen::Vector3d::Constant(1e3);
    settings.slew = Eigen::Vector3d::Constant(1e9);
  }
  return SafetyLimiter<Omni<>>(settings);
}

PalpationResult palpate(const Scene& scene, PredictorKind predictor, const ProgressCallback& progress) {
  if (scene.hand && scene.playback) {
    throw std::invalid_argument("Scene: hand: expected none with playback, in which nothing holds the arm");
  }
  switch (predictor) {
    case PredictorKind::hold:
      return palpate_with_hold(scene, progress);
    case PredictorKind::model:
      return scene.estimation.known ? palpate_with_known_model(scene, progress)
                                    : palpate_with_estimated_model(scene, progress);
    case PredictorKind::ideal:
      return palpate_with_ideal_signal(scene, progress);
  }
  throw std::invalid_argument("palpate: unknown predictor");
}

}  // namespace limpid::examples
