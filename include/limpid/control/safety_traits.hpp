// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/torque_set.hpp>
#include <limpid/robot/robot.hpp>

namespace limpid {

/// What a SafetyLimiter must know of a robot beyond the limits of its joints; specialise it for a robot with limits
/// that join several joints. Each rule takes torques out of `allowed` that lead toward such a limit:
///
///     static constexpr int half_spaces;                                       // most that the rules may demand
///     static void limit_joints(const R&, q, margin, allowed) noexcept;        // margin, rad
///     static void limit_workspace(const R&, q, margin, allowed) noexcept;     // margin, m
template <typename R>
struct SafetyTraits {
  static constexpr int half_spaces = 0;
  using Allowed = TorqueSet<RobotTraits<R>::joints, RobotScalar<R>, half_spaces>;

  static void limit_joints(const R&, const JointVector<R>&, const RobotScalar<R>&, Allowed&) noexcept {}
  static void limit_workspace(const R&, const JointVector<R>&, const RobotScalar<R>&, Allowed&) noexcept {}
};

}  // namespace limpid
