// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <concepts>
#include <utility>

namespace limpid {

/// What the joints of a robot stand, Table 5.1.
template <int Joints, Real Scalar = double>
struct JointLimits {
  using Vector = Eigen::Matrix<Scalar, Joints, 1>;
  Vector lower;            ///< rad
  Vector upper;            ///< rad
  Vector torque;           ///< largest magnitude, N m
  Vector static_friction;  ///< N m
};

/// How limpid sees a robot of type R; specialise it to adapt a foreign type. Minimal:
///
///     using Scalar;                       // a Real
///     static constexpr int joints;        // n
///     static constexpr int parameters;    // p, length of the vector theta in which the dynamics (3.16) are linear
///     static Pose at(const R&, q);        // everything that shares the sines and cosines of q: a RobotPose
///     static JointLimits limits(const R&);
///
/// A type with members of these names needs no specialisation.
template <typename R>
struct RobotTraits {};

template <typename R>
requires requires(const R robot, const Eigen::Matrix<typename R::Scalar, R::joints, 1> q) {
  R::parameters;
  robot.at(q);
  robot.limits();
}
struct RobotTraits<R> {
  using Scalar = typename R::Scalar;
  static constexpr int joints = R::joints;
  static constexpr int parameters = R::parameters;

  static auto at(const R& robot, const Eigen::Matrix<Scalar, joints, 1>& q) noexcept { return robot.at(q); }
  static auto limits(const R& robot) noexcept { return robot.limits(); }
};

template <typename R>
using RobotScalar = typename RobotTraits<R>::Scalar;

/// n x 1: angles, rates, accelerations or torques of the joints of R.
template <typename R>
using JointVector = Eigen::Matrix<RobotScalar<R>, RobotTraits<R>::joints, 1>;

/// p x 1: the parameters theta of R.
template <typename R>
using RobotParameters = Eigen::Matrix<RobotScalar<R>, RobotTraits<R>::parameters, 1>;

/// 3 x n: J and its derivative.
template <typename R>
using JacobianMatrix = Eigen::Matrix<RobotScalar<R>, 3, RobotTraits<R>::joints>;

/// n x n: H, C and B.
template <typename R>
using JointMatrix = Eigen::Matrix<RobotScalar<R>, RobotTraits<R>::joints, RobotTraits<R>::joints>;

/// n x p: phi and phi_r.
template <typename R>
using RegressorMatrix = Eigen::Matrix<RobotScalar<R>, RobotTraits<R>::joints, RobotTraits<R>::parameters>;

/// A robot at one q: kinematics and the dynamics H q'' + (C + B) q' + tau_g = phi theta, (3.15), (3.16).
///
///     position()                                            tip in the base frame, m
///     jacobian(), jacobian_dot(qdot)                        J, m/rad, and J', m/(rad s)
///     H(theta), C(theta, qdot), B(theta), tau_g(theta)      inertia, Coriolis, viscous friction, gravity
///     regressor(qdot, qddot)                                phi of (3.16)
///     regressor(qdot, qdot_r, qddot_r)                      phi_r of (3.27)
///     torque(theta, qdot, qdot_r, qddot_r)                  phi_r theta, N m, without forming phi_r
///     adaptation_direction(qdot, qdot_r, qddot_r, delta)    phi_r' delta of (4.8), likewise
///
/// Laws: H = H' > 0 for a physical theta; H' - 2 C is skew along any motion (Property 2); all are linear in theta and
/// agree with each other as named; a non-finite argument gives a non-finite answer and nothing worse; nothing throws or
/// allocates. test/conformance/robot_suite.hpp checks them for any type.
template <typename P, typename R>
concept RobotPose = requires(const P pose, const JointVector<R> rate, const RobotParameters<R> theta) {
  { pose.position() } -> std::convertible_to<Eigen::Matrix<RobotScalar<R>, 3, 1>>;
  { pose.jacobian() } -> std::convertible_to<JacobianMatrix<R>>;
  { pose.jacobian_dot(rate) } -> std::convertible_to<JacobianMatrix<R>>;
  { pose.H(theta) } -> std::convertible_to<JointMatrix<R>>;
  { pose.C(theta, rate) } -> std::convertible_to<JointMatrix<R>>;
  { pose.B(theta) } -> std::convertible_to<JointMatrix<R>>;
  { pose.tau_g(theta) } -> std::convertible_to<JointVector<R>>;
  { pose.regressor(rate, rate) } -> std::convertible_to<RegressorMatrix<R>>;
  { pose.regressor(rate, rate, rate) } -> std::convertible_to<RegressorMatrix<R>>;
  { pose.torque(theta, rate, rate, rate) } -> std::convertible_to<JointVector<R>>;
  { pose.adaptation_direction(rate, rate, rate, rate) } -> std::convertible_to<RobotParameters<R>>;
};

/// An arm whose dynamics are linear in constant parameters. Models: Omni, FiveBar.
template <typename R>
concept Robot = Real<RobotScalar<R>> && requires(const R robot, const JointVector<R> q) {
  { RobotTraits<R>::at(robot, q) } -> RobotPose<R>;
  { RobotTraits<R>::limits(robot) } -> std::convertible_to<JointLimits<RobotTraits<R>::joints, RobotScalar<R>>>;
};

/// The type of a robot's pose.
template <Robot R>
using PoseOf = decltype(RobotTraits<R>::at(std::declval<const R&>(), std::declval<const JointVector<R>&>()));

}  // namespace limpid
