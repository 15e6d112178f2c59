// SPDX-License-Identifier: MIT
#include "palpation_loops.hpp"
#include "palpation_run.hpp"

#include <stdexcept>
#include <string>

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

}  // namespace

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
