// SPDX-License-Identifier: MIT
#include "palpation_arm.hpp"

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

SlotineLiAdaptive<Omni<>>::Settings controller_settings(const Scene& scene) {
  Theta9 Gamma;
  Gamma << 0.01, 0.002, 0.002, 0.0005, 0.001, 0.001, 0.02, 0.02, 0.02;
  return {.Lambda = {2.8, 3.0, 1.5}, .Kd = {0.4, 0.28, 0.10}, .Gamma = Gamma, .theta0 = first_estimate(scene)};
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

}  // namespace limpid::examples
