// SPDX-License-Identifier: MIT
#include "peers/limpid_functions.hpp"

#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>

namespace limpid::bench {

namespace {

// (3.25)
Omni<>::Parameters theta_of(const ArmModel& model) {
  const Body &b1 = model.bodies[0], &b2 = model.bodies[1], &b3 = model.bodies[2];
  const double l2 = model.rows[2].a, c2 = b2.centre[0], c3 = b3.centre[0];
  Omni<>::Parameters theta;
  theta << b1.inertia(2, 2), b2.mass * c2 * c2 + b2.inertia(2, 2) + b3.mass * l2 * l2,
      b3.mass * c3 * c3 + b3.inertia(2, 2), b3.mass * l2 * c3, b2.mass * c2 + b3.mass * l2, b3.mass * c3, 0, 0, 0;
  return theta;
}

}  // namespace

std::vector<Function> limpid_omni(const ArmModel& model, const std::vector<Motion>& motions) {
  using Arm = LimpidArm<Omni<>, OmniKinematics<>>;
  const Omni<> robot({.link2 = model.rows[2].a, .link3 = model.tip[0], .gravity = -model.gravity[2]});
  const auto arm = std::make_shared<const Arm>(robot, theta_of(model), motions);
  return limpid_functions(
      arm, [arm](const Arm::State& s) -> Arm::Joints { return arm->robot.at(s.q).C(arm->theta, s.qdot) * s.qdot; });
}

}  // namespace limpid::bench
