// SPDX-License-Identifier: MIT
#include "palpation_operator.hpp"

#include <limpid/robot/omni.hpp>

namespace limpid::examples {

namespace {

using One = OperatorHand<1>::Vector;

std::optional<OperatorHand<1>> hand_of(const Scene& scene) {
  if (!scene.hand) return {};
  return OperatorHand<1>(
      {.mass = One(scene.hand->mass), .damping = One(scene.hand->damping), .stiffness = One(scene.hand->stiffness)});
}

}  // namespace

PalpationOperator::PalpationOperator(const Scene& scene, double wall)
    : scene_{scene}, wall_{wall}, hand_{hand_of(scene)} {}

double PalpationOperator::press(Time now, const SimulatedOmni<>& device) {
  if (!hand_) return scene_.force.at(now);
  const int tries = scene_.robot == RobotKind::ideal ? 1 : 4;
  OperatorHand<1> tried = *hand_;
  for (int i = 0; i < tries; ++i) {
    tried = *hand_;
    SimulatedOmni<> moved = device;
    status_ = moved.advance(now, {force_, 0, 0});
    const auto [force, status] = hold(tried, now, moved);
    force_ = force[0];
    status_ |= status;
  }
  hand_ = tried;
  return force_;
}

HandEnergy<> PalpationOperator::energy() const { return hand_ ? hand_->energy() : HandEnergy<>{}; }

OperatorHand<1>::Output PalpationOperator::hold(OperatorHand<1>& hand, Time now, const SimulatedOmni<>& device) const {
  const auto truth = device.true_state();
  const auto pose = Omni<>{}.at(truth.q);
  const double x = pose.position()[0] - wall_, v = (pose.jacobian() * truth.qdot)[0];
  return hand.advance(now, One(scene_.force.at(now)), One(x), One(v));
}

}  // namespace limpid::examples
