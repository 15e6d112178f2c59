// SPDX-License-Identifier: MIT
#include "peers/limpid_functions.hpp"

#include <limpid/robot/body_inertia.hpp>
#include <limpid/robot/chain_kinematics.hpp>
#include <limpid/robot/serial_chain.hpp>

#include <algorithm>

namespace limpid::bench {

namespace {

using Chain = SerialChain<6>;

Chain chain_of(const ArmModel& model, const Eigen::Vector3d& gravity) {
  Chain::Settings settings{.links = {}, .tip = model.tip, .gravity = gravity};
  std::copy_n(model.rows.begin(), 6, settings.links.begin());
  return Chain(settings);
}

Chain::Parameters theta_of(const ArmModel& model) {
  Chain::PerLink<BodyParameters<double>> links;
  std::transform(model.bodies.begin(), model.bodies.end(), links.begin(),
                 [](const Body& body) { return rigid_body(body.mass, body.centre, body.inertia); });
  return Chain::theta(links);
}

}  // namespace

std::vector<Function> limpid_chain(const ArmModel& model, const std::vector<Motion>& motions) {
  using Arm = LimpidArm<Chain, ChainKinematics<6>>;
  const auto arm = std::make_shared<const Arm>(chain_of(model, model.gravity), theta_of(model), motions);
  // The recursion without gravity: cheaper than C.
  return limpid_functions(arm, [arm, weightless = chain_of(model, Eigen::Vector3d::Zero())](const Arm::State& s) {
    return weightless.at(s.q).torque(arm->theta, s.qdot, s.qdot, Arm::Joints::Zero());
  });
}

}  // namespace limpid::bench
