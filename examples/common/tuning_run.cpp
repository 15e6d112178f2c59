// SPDX-License-Identifier: MIT
#include "tuning_run.hpp"

#include <numbers>

namespace limpid::examples {

using std::numbers::pi;

Eigen::Vector3d tuning_pose() { return {0, pi / 4, -1.5}; }

DesiredJoints<3> tuning_reference(double t, const Eigen::Vector3d& q0) {
  const Eigen::Array3d amplitude{pi / 8, pi / 7, pi / 10}, omega{0.6 * pi, 0.4 * pi, 0.46 * pi};
  const Eigen::Array3d sine = (omega * t).sin(), cosine = (omega * t).cos();
  return {q0 + Eigen::Vector3d(0, 0.1, 0) + (amplitude * cosine).matrix(), (-amplitude * omega * sine).matrix(),
          (-amplitude * omega * omega * cosine).matrix()};
}

SlotineLiAdaptive<Omni<>> tuned_controller(const Omni<>::Parameters& theta0) {
  Omni<>::Parameters Gamma;
  Gamma << 0.01, 0.002, 0.002, 0.0005, 0.001, 0.001, 0.02, 0.02, 0.02;
  return SlotineLiAdaptive<Omni<>>(
      {.Lambda = {2.8, 3.0, 1.5}, .Kd = {0.4, 0.28, 0.10}, .Gamma = Gamma, .theta0 = theta0});
}

}  // namespace limpid::examples
