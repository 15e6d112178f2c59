// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/robot/denavit_hartenberg.hpp>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace limpid::bench {

/// A link in its frame.
struct Body {
  double mass;              ///< kg
  Eigen::Vector3d centre;   ///< m
  Eigen::Matrix3d inertia;  ///< about the centre, kg m^2
};

/// An arm by its links, from which every library makes its own.
struct ArmModel {
  std::string name;
  std::vector<DenavitHartenberg<double>> rows;
  std::vector<Body> bodies;
  Eigen::Vector3d tip;           ///< in the last frame, m
  Eigen::Vector3d gravity;       ///< m/s^2
  Eigen::VectorXd lower, upper;  ///< of the joints at which it is compared, rad

  /// Frame i in frame i - 1 where joint i is at zero.
  [[nodiscard]] RigidTransform<double> placement(std::size_t i) const {
    return DenavitHartenbergRow<double>(rows[i]).at(0.0);
  }
};

struct Motion {
  Eigen::VectorXd q, qdot, qddot;  // rad, rad/s, rad/s^2
  Eigen::VectorXd near;            // rad; where a search for q begins
};

/// The Omni of section 3.3 with uniform rods as links 2 and 3, for which (3.25) gives theta.
[[nodiscard]] ArmModel omni_model();

/// The PUMA 560 by Armstrong, Khatib and Burdick (1986), with boxes as links.
[[nodiscard]] ArmModel puma_model();

[[nodiscard]] std::vector<Motion> random_motions(const ArmModel& model, unsigned seed, int count);

}  // namespace limpid::bench
