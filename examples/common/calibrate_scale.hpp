// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace limpid::examples {

/// What an operator has measured: the torque of a joint at a part of its converter's range, by a weight on a lever or a
/// force sensor.
struct MeasuredTorque {
  int joint;      ///< 0 to 2
  double part;    ///< u of the converter, of [-1, 1]
  double torque;  ///< at the model's joint, N m, with its sign
};

/// From lines "joint,part,torque", joints counted from 1; empty lines and those that begin with # are none.
/// @throws std::invalid_argument  "PATH:LINE: expected ..., got ..."
[[nodiscard]] std::vector<MeasuredTorque> read_measured_torques(const std::string& path);

/// OmniCalibration's full_scale, N m: the slope of each joint's torque over its part, by least squares with an offset
/// for the arm's weight, over the gain of (5.5).
/// @throws std::invalid_argument  where a joint has fewer than two different parts, or a slope whose sign is not that
///                                of (5.5)
[[nodiscard]] Eigen::Vector3d full_scale_of(const std::vector<MeasuredTorque>& measured);

}  // namespace limpid::examples
