// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/torque_set.hpp>
#include <limpid/core/real.hpp>
#include <limpid/robot/robot.hpp>

namespace limpid {

/// How near to a limit a rule sets in, rad or m: over the band before the margin it takes more and more torque away,
/// and from the margin on all that leads toward the limit.
template <Real Scalar = double>
struct SafetyMargin {
  Scalar margin;  ///< from the limit, >= 0
  Scalar band;    ///< before the margin, >= 0

  /// What is left of the torque toward a limit at this distance: 0 up to the margin, 1 beyond the band.
  /// @realtime  no allocation, no throw
  [[nodiscard]] Scalar share(const Scalar& distance) const noexcept {
    const Scalar clear = distance - margin;
    if (!(clear > Scalar(0))) return Scalar(0);
    return clear < band ? clear / band : Scalar(1);
  }
};

/// What a SafetyLimiter must know of a robot beyond the limits of its joints; specialise it for a robot with limits
/// that join several joints. Each rule takes torques out of `allowed` that lead toward such a limit:
///
///     static constexpr int half_spaces;                                       // most that the rules may demand
///     static void limit_joints(const R&, q, margin, allowed) noexcept;        // margin, rad
///     static void limit_workspace(const R&, q, margin, allowed) noexcept;     // margin, m
///
/// A robot without a specialisation is limited by its joints alone.
template <typename R>
struct SafetyTraits {
  static constexpr int half_spaces = 0;
  using Scalar = RobotScalar<R>;
  using Allowed = TorqueSet<RobotTraits<R>::joints, Scalar, half_spaces>;

  static void limit_joints(const R&, const JointVector<R>&, const SafetyMargin<Scalar>&, Allowed&) noexcept {}
  static void limit_workspace(const R&, const JointVector<R>&, const SafetyMargin<Scalar>&, Allowed&) noexcept {}
};

}  // namespace limpid
