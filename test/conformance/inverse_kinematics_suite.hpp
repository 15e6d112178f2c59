// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/status.hpp>
#include <limpid/robot/inverse_kinematics.hpp>
#include <limpid/robot/robot.hpp>

#include "support/no_allocation.hpp"

#include <Eigen/Core>

#include <doctest/doctest.h>

#include <limits>

namespace limpid::test {

/// The laws of the concept InverseKinematics for `kinematics` of `robot`, at joints q well inside its limits.
template <InverseKinematics K, Robot R>
void check_inverse_kinematics(const K& kinematics, const R& robot, const JointVector<R>& q) {
  using Scalar = RobotScalar<R>;
  using Traits = InverseKinematicsTraits<K>;
  using Joints = JointVector<R>;
  using Point = Eigen::Matrix<Scalar, 3, 1>;
  const Scalar tolerance =
      1000 * std::numeric_limits<Scalar>::epsilon();  // of values up to 1, times the condition of J
  const auto near = [&](const auto& a, const auto& b) { return (a - b).cwiseAbs().maxCoeff() <= tolerance; };

  const auto pose = RobotTraits<R>::at(robot, q);
  const Joints qdot = Joints::Constant(Scalar(1) / Scalar(2)), qddot = Joints::Constant(Scalar(-3) / Scalar(4));
  const Point x = pose.position(), v = pose.jacobian() * qdot;
  const Point a = pose.jacobian_dot(qdot) * qdot + pose.jacobian() * qddot;  // (3.10)

  SUBCASE("joints, rates and accelerations come back") {
    const auto motion = Traits::inverse(kinematics, x, v, a, q);
    CHECK(near(motion.q, q));
    CHECK(near(motion.qdot, qdot));
    CHECK(near(motion.qddot, qddot));
    CHECK(motion.status == Status::ok);
    const auto joints = Traits::inverse(kinematics, x, q);
    CHECK((joints.q.array() == motion.q.array()).all());
    CHECK(joints.status == Status::ok);
  }

  SUBCASE("far away is unreachable, and the answer finite") {
    const auto motion = Traits::inverse(kinematics, Point(x * Scalar(1000)), v, a, q);
    CHECK(has(motion.status, Status::unreachable));
    CHECK((is_finite(motion.q) && is_finite(motion.qdot) && is_finite(motion.qddot)));
  }

  SUBCASE("a target that is not finite gives `near` at rest") {
    for (const Scalar& broken : {std::numeric_limits<Scalar>::quiet_NaN(), std::numeric_limits<Scalar>::infinity()}) {
      for (int input = 0; input < 9; ++input) {
        Point target[3] = {x, v, a};
        target[input / 3][input % 3] = broken;
        const auto motion = Traits::inverse(kinematics, target[0], target[1], target[2], q);
        CHECK((motion.q.array() == q.array()).all());
        CHECK((motion.qdot.array() == Scalar(0)).all());
        CHECK((motion.qddot.array() == Scalar(0)).all());
        CHECK(has(motion.status, Status::not_finite));
      }
      Point target = x;
      target[1] = broken;
      CHECK((Traits::inverse(kinematics, target, q).q.array() == q.array()).all());
      CHECK(has(Traits::inverse(kinematics, target, q).status, Status::not_finite));
    }
  }

  SUBCASE("nothing allocates") {
    bool finite = false;
    check_no_allocation([&] { finite = is_finite(Joints(Traits::inverse(kinematics, x, v, a, q).qddot)); });
    CHECK(finite);
  }
}

}  // namespace limpid::test
