// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <cmath>

namespace limpid {

/// Between the Omni's own angles and torques and those of the thesis's model: (5.1), (5.2), (5.5).
///
/// `device_...` goes from the model to the device; the other functions come from it. A non-finite argument gives a
/// non-finite answer.
/// @realtime  no allocation, no throw; at most 3 flops
template <Real Scalar = double>
struct OmniDevice {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;

  /// q from the device's joint angles, rad. Eq. (5.1).
  [[nodiscard]] static Vector joints(const Vector& q_omni) noexcept {
    return {-q_omni[0], q_omni[1], q_omni[2] - q_omni[1] - quarter_turn()};
  }
  /// The device's joint angles, rad. Eq. (5.1) solved.
  [[nodiscard]] static Vector device_joints(const Vector& q) noexcept {
    return {-q[0], q[1], q[2] + q[1] + quarter_turn()};
  }

  /// q' from the device's joint rates, rad/s. Eq. (5.1) differentiated.
  [[nodiscard]] static Vector rates(const Vector& qdot_omni) noexcept {
    return {-qdot_omni[0], qdot_omni[1], qdot_omni[2] - qdot_omni[1]};
  }
  /// The device's joint rates, rad/s.
  [[nodiscard]] static Vector device_rates(const Vector& qdot) noexcept {
    return {-qdot[0], qdot[1], qdot[2] + qdot[1]};
  }

  /// Yaw, pitch and roll of the stylus from the device's gimbal angles, rad. Eq. (5.2).
  [[nodiscard]] static Vector yaw_pitch_roll(const Vector& gimbal) noexcept {
    return {gimbal[0], gimbal[1], -gimbal[2]};
  }
  /// The device's gimbal angles, rad. Eq. (5.2) solved.
  [[nodiscard]] static Vector device_gimbal(const Vector& yaw_pitch_roll) noexcept {
    return {yaw_pitch_roll[0], yaw_pitch_roll[1], -yaw_pitch_roll[2]};
  }

  /// The torque that a command makes at the joints, N m. Eq. (5.5).
  [[nodiscard]] static Vector torque(const Vector& command) noexcept {
    return {-command[0], command[1], command[2] * third_gain()};
  }
  /// The command that makes a torque at the joints, N m. Eq. (5.5) solved.
  [[nodiscard]] static Vector device_torque(const Vector& torque) noexcept {
    return {-torque[0], torque[1], torque[2] / third_gain()};
  }

 private:
  [[nodiscard]] static Scalar quarter_turn() noexcept {
    using std::acos;
    return acos(Scalar(-1)) / Scalar(2);
  }
  [[nodiscard]] static Scalar third_gain() noexcept { return Scalar(143) / Scalar(100); }
};

}  // namespace limpid
