// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/safe_torque.hpp>
#include <limpid/device/haptic_device.hpp>
#include <limpid/environment/environment.hpp>
#include <limpid/environment/tool.hpp>
#include <limpid/estimation/environment_estimator.hpp>
#include <limpid/prediction/predictor.hpp>
#include <limpid/robot/inverse_kinematics.hpp>
#include <limpid/robot/robot.hpp>
#include <limpid/signal/sample.hpp>

#include <Eigen/Core>

/// Signals of a palpation, from the operator's hand to the device; what a `Loop` carries from block to block.
namespace limpid::palpation {

/// F_h at the tip, base frame, N; the press axis is +x, into the wall.
template <Real Scalar = double>
struct OperatorForce {
  using value_type = Eigen::Matrix<Scalar, 3, 1>;
};

/// The part of F_h that acts on the arm too and that the controller therefore takes off, N: F_h itself, or zero where a
/// recorded force is played to the environment alone (7.1).
template <Real Scalar = double>
struct ForceOnArm {
  using value_type = Eigen::Matrix<Scalar, 3, 1>;
};

/// The tool in the environment as it truly is now; only a simulated environment can give it.
template <int Axes = 1, Real Scalar = double>
struct TrueTool {
  using value_type = ToolState<Axes, Scalar>;
};

/// The tool as the loop sees it: sampled, late, held.
template <int Axes = 1, Real Scalar = double>
struct SeenTool {
  using value_type = Held<ToolState<Axes, Scalar>>;
};

/// theta_hat and when it was found.
template <Environment Env>
struct Estimate {
  using value_type = EnvironmentEstimate<EnvironmentTraits<Env>::axes, EnvironmentTraits<Env>::parameters,
                                         typename EnvironmentTraits<Env>::Scalar>;
  static constexpr const char* name = "EnvironmentEstimate";
};

/// The tool now, as predicted.
template <int Axes = 1, Real Scalar = double>
struct PredictedMotion {
  using value_type = Prediction<Axes, Scalar>;
};

/// q_e and its derivatives.
template <Robot R>
struct DesiredState {
  using value_type = InverseMotion<RobotTraits<R>::joints, RobotScalar<R>>;
};

/// The device as read; its status is heard by the whole tick.
template <Robot R>
struct MeasuredState {
  using value_type = DeviceState<RobotTraits<R>::joints, RobotScalar<R>>;
};

/// tau as the controller wants it, N m.
template <Robot R>
struct WantedTorque {
  using value_type = JointVector<R>;
};

/// tau as the device may have it, N m.
template <Robot R>
struct AllowedTorque {
  using value_type = SafeTorque<RobotTraits<R>::joints, RobotScalar<R>>;
  static value_type initial() noexcept { return {}; }  // zero torque
};

}  // namespace limpid::palpation
