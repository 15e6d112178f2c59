// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/robot/cartesian_dynamics.hpp>
#include <limpid/robot/five_bar.hpp>
#include <limpid/robot/omni.hpp>
#include <support/maximum.hpp>

#include <Eigen/Core>

#include <doctest/doctest.h>

#include <limits>
#include <random>

namespace limpid::test {

/// The worst error of many motions, N m or N, and the largest torque among them, N m.
struct Inconsistency {
  double worst = 0, largest = 0;
};

/// Joints of the Omni whose tip is 8 cm and more off the vertical axis, where J is singular.
template <Real Scalar>
JointLimits<3, Scalar> clear_of_axis() {
  auto limits = Omni<Scalar>().limits();
  limits.lower[2] = Scalar(-2);
  limits.upper[1] = Scalar(1);
  return limits;
}

/// How far (2) is from the torque of (1) on random motions within the limits: J^T F from tau, or with fewer axes than
/// joints F from J_inverse^T tau.
template <int Axes, Robot R>
Inconsistency inconsistency(const R& robot, const RobotParameters<R>& theta,
                            const TaskDirections<Axes, RobotScalar<R>>& axes,
                            const JointLimits<RobotTraits<R>::joints, RobotScalar<R>>& limits, unsigned seed,
                            int trials) {
  using Scalar = RobotScalar<R>;
  using Joints = JointVector<R>;
  std::mt19937 random(seed);
  const auto vector = [&](int size) {
    Joints v;
    for (auto& entry : v) entry = Scalar(size) * Scalar(std::uniform_real_distribution<double>(-1, 1)(random));
    return v;
  };
  Inconsistency found;
  Status status = Status::ok;
  for (int i = 0; i < trials; ++i) {
    const Joints share = (Joints::Ones() + vector(1)) / Scalar(2);
    const Joints q = limits.lower + share.cwiseProduct(limits.upper - limits.lower);
    const Joints qdot = vector(3), qddot = vector(30), coulomb = vector(1);
    const auto pose = RobotTraits<R>::at(robot, q);
    const auto tip = cartesian_dynamics<R, Axes>(robot, theta, {q, qdot}, axes, coulomb);
    const Joints tau = pose.torque(theta, qdot, qdot, qddot) + coulomb;  // (1)
    const Eigen::Matrix<Scalar, Axes, RobotTraits<R>::joints> J = axes * pose.jacobian();
    const Eigen::Matrix<Scalar, Axes, RobotTraits<R>::joints> Jdot = axes * pose.jacobian_dot(qdot);
    const Eigen::Matrix<Scalar, Axes, 1> F = tip.force(J * qdot, J * qddot + Jdot * qdot);
    Scalar error;
    if constexpr (Axes == RobotTraits<R>::joints) {
      error = largest_entry(J.transpose() * F - tau);
    } else {
      error = largest_entry(F - tip.J_inverse.transpose() * tau);
    }
    found.worst = maximum(found.worst, static_cast<double>(error));
    found.largest = maximum(found.largest, static_cast<double>(largest_entry(tau)));
    status |= tip.status;
  }
  CHECK(status == Status::ok);
  return found;
}

/// The Omni on three axes, the five-bar on two; their J has a condition below 100, which M_x has squared.
template <Real Scalar>
void check_three_and_two(int trials, unsigned seed) {
  CAPTURE(seed);
  const double tolerance = 1e4 * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
  const Eigen::Matrix<Scalar, 3, 3> space = Eigen::Matrix<Scalar, 3, 3>::Identity();
  const Inconsistency three =
      inconsistency<3>(Omni<Scalar>(), Omni<Scalar>::table_5_2(), space, clear_of_axis<Scalar>(), seed, trials);
  CHECK(three.worst <= tolerance * three.largest);
  const FiveBar<Scalar> robot;
  const Eigen::Matrix<Scalar, 2, 3> plane = space.template topRows<2>();
  const Inconsistency two = inconsistency<2>(robot, robot.theta_of({}), plane, robot.limits(), seed, trials);
  CHECK(two.worst <= tolerance * two.largest);
}

}  // namespace limpid::test
