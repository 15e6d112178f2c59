// SPDX-License-Identifier: MIT
#pragma once

#include "peers/function.hpp"

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace limpid::bench {

/// A robot of limpid with all that its functions are called with, in its own types.
template <typename Robot, typename Kinematics>
struct LimpidArm {
  using Joints = Eigen::Vector<double, Robot::joints>;
  using Parameters = Eigen::Vector<double, Robot::parameters>;
  struct State {
    Joints q, qdot, qddot, near;
    Eigen::Vector3d x;
  };

  Robot robot;
  Kinematics kinematics;
  Parameters theta;
  std::vector<State> states;

  LimpidArm(const Robot& arm, const Parameters& parameters, const std::vector<Motion>& motions)
      : robot{arm}, kinematics{arm}, theta{parameters} {
    constexpr int n = Robot::joints;
    for (const Motion& m : motions) {
      const Joints q = m.q.head<n>();
      states.push_back({q, m.qdot.head<n>(), m.qddot.head<n>(), m.near.head<n>(), robot.at(q).position()});
    }
  }
};

/// @param coriolis  C q' at a state
template <typename Robot, typename Kinematics, typename Coriolis>
[[nodiscard]] std::vector<Function> limpid_functions(std::shared_ptr<const LimpidArm<Robot, Kinematics>> arm,
                                                     Coriolis coriolis) {
  const std::size_t motions = arm->states.size();
  const auto same = [](const auto& value) { return value; };
  const auto at = [&](const std::string& name, auto of, auto value) {
    return function(
        name, motions,
        [arm, of](std::size_t i) {
          const auto& state = arm->states[i];
          return of(arm->robot.at(state.q), arm->theta, state);
        },
        value);
  };
  return {
      at(
          names::forward, [](const auto& pose, auto&, auto&) { return pose.position(); }, same),
      at(
          names::jacobian, [](const auto& pose, auto&, auto&) { return pose.jacobian(); }, same),
      at(
          names::inertia, [](const auto& pose, auto& theta, auto&) { return pose.H(theta); }, same),
      at(
          names::coriolis_matrix, [](const auto& pose, auto& theta, auto& s) { return pose.C(theta, s.qdot); }, same),
      function(
          names::coriolis, motions, [arm, coriolis](std::size_t i) { return coriolis(arm->states[i]); }, same),
      at(
          names::gravity, [](const auto& pose, auto& theta, auto&) { return pose.tau_g(theta); }, same),
      at(
          names::torque,
          [](const auto& pose, auto& theta, auto& s) { return pose.torque(theta, s.qdot, s.qdot, s.qddot); }, same),
      at(
          names::regressor, [](const auto& pose, auto&, auto& s) { return pose.regressor(s.qdot, s.qddot); },
          [arm](const auto& phi) { return phi * arm->theta; }),
      function(
          names::inverse, motions,
          [arm](std::size_t i) { return arm->kinematics.inverse(arm->states[i].x, arm->states[i].near); },
          [arm](const auto& joints) { return arm->robot.at(joints.q).position(); })};
}

}  // namespace limpid::bench
