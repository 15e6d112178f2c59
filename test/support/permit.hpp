// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/safety_limiter.hpp>

namespace limpid::test {

/// Makes a SafeTorque of any finite torque, through a limiter set to let everything pass: for tests of what comes
/// after it.
template <Robot R>
SafeTorque<RobotTraits<R>::joints, RobotScalar<R>> permit(const R& robot, const JointVector<R>& torque) {
  using Scalar = RobotScalar<R>;
  SafetyLimiter<R> limiter({.robot = robot,
                            .safety_factor = Scalar(1),
                            .torque_limit = JointVector<R>(JointVector<R>::Constant(Scalar(1e6))),
                            .slew = JointVector<R>(JointVector<R>::Constant(Scalar(1e12))),
                            .workspace = false});
  const auto limits = RobotTraits<R>::limits(robot);
  const JointVector<R> middle = (limits.lower + limits.upper) / Scalar(2);
  const JointState<RobotTraits<R>::joints, Scalar> at_rest{middle, JointVector<R>::Zero()};
  (void)limiter.limit(Time{0}, at_rest, torque);
  return limiter.limit(Time{1'000'000}, at_rest, torque).torque;
}

}  // namespace limpid::test
