// SPDX-License-Identifier: MIT
// The Phantom Omni: where its tip is, what holds it up, and the joints for a point.
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>

#include <cstdio>

int main() {
  const limpid::Omni<> arm;
  const Eigen::Vector3d q(0.1, 0.8, -1.3), still = Eigen::Vector3d::Zero();
  const auto pose = arm.at(q);  // one set of sines and cosines for all that follows
  const Eigen::Vector3d x = pose.position(), holding = pose.torque(limpid::Omni<>::table_5_2(), still, still, still);
  std::printf("tip at %.4f %.4f %.4f m, held by %.4f %.4f %.4f N m\n", x[0], x[1], x[2], holding[0], holding[1],
              holding[2]);

  const limpid::OmniKinematics<> kinematics(arm);
  const auto back = kinematics.inverse(x);
  const auto far = kinematics.inverse(Eigen::Vector3d(0.5, 0, 0.1));  // beyond the arm: the nearest reachable point
  std::printf("back at %.4f %.4f %.4f rad; half a metre away: %s\n", back.q[0], back.q[1], back.q[2],
              limpid::describe(far.status).c_str());
  return (back.q - q).norm() < 1e-12 && limpid::has(far.status, limpid::Status::unreachable) ? 0 : 1;
}
