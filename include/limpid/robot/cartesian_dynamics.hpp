// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/robot/joint_state.hpp>
#include <limpid/robot/robot.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <limits>

namespace limpid {

/// A robot's dynamics at its tip, Eom, Suh and Yi (2), on m task axes: F = M_x x'' + V_x + G_x + B_x x' + H_x.
template <int Joints, int Axes, Real Scalar = double>
struct CartesianDynamics {
  using Vector = Eigen::Matrix<Scalar, Axes, 1>;
  using Matrix = Eigen::Matrix<Scalar, Axes, Axes>;

  Matrix M_x;                                     ///< inertia, kg
  Vector V_x;                                     ///< Coriolis and centrifugal force, N
  Vector G_x;                                     ///< gravity, N
  Matrix B_x;                                     ///< viscous friction, N s/m
  Vector H_x;                                     ///< Coulomb friction, N
  Eigen::Matrix<Scalar, Joints, Axes> J_inverse;  ///< F = J_inverse^T tau, rad/m
  Status status;                                  ///< singular, not_finite

  /// F of (2), N.
  /// @param v, a  of the tip on the task axes, m/s, m/s^2
  [[nodiscard]] Vector force(const Vector& v, const Vector& a) const noexcept {
    return M_x * a + V_x + G_x + B_x * v + H_x;
  }

  /// F_xd of (3), N: what the tip needs beyond a mass and a damper on each axis, F = M_n a + B_n v + F_xd.
  /// (4) leaves out (B_x - B_n) v; without it (2) and (3) would differ.
  /// @param M_n, B_n  nominal mass and damping of each axis, kg, N s/m
  [[nodiscard]] Vector equivalent_disturbance(const Vector& M_n, const Vector& B_n, const Vector& v,
                                              const Vector& a) const noexcept {
    return force(v, a) - M_n.cwiseProduct(a) - B_n.cwiseProduct(v);
  }
};

/// Task axes of R by default: x and y for two joints, x, y and z for more, x for one.
template <Robot R>
inline constexpr int task_axes = std::min(RobotTraits<R>::joints, 3);

/// m x 3: a direction of the base frame in each row.
template <int Axes, Real Scalar = double>
using TaskDirections = Eigen::Matrix<Scalar, Axes, 3>;

namespace detail {

/// Inverse of the m x n Jacobian with respect to the tip's inertia, and whether it had to be damped.
///
/// J^-1 for m = n. For m < n, H^-1 J^T (J H^-1 J^T)^-1. With A = J J^T and J H^-1 J^T respectively, the pose
/// counts as singular where det A is below 2^-14 of (tr A / m)^m, for two axes where a singular value is 1/256 of the
/// other; there A has a multiple of the unit matrix added, which keeps the answer bounded. A tip that cannot move along
/// any axis has J^-1 = 0.
template <int Joints, int Axes, Real Scalar>
struct TaskInverse {
  using Wide = Eigen::Matrix<Scalar, Joints, Axes>;
  using Square = Eigen::Matrix<Scalar, Axes, Axes>;

  Wide J_inverse;
  bool singular;

  TaskInverse(const Eigen::Matrix<Scalar, Axes, Joints>& J, const Eigen::Matrix<Scalar, Joints, Joints>& H) noexcept {
    Wide spread = J.transpose();
    if constexpr (Axes < Joints) {
      const Eigen::LLT<Eigen::Matrix<Scalar, Joints, Joints>> factor(H);
      spread = factor.solve(spread).eval();
      if (factor.info() != Eigen::Success) spread.setConstant(std::numeric_limits<Scalar>::quiet_NaN());
    }
    Square A = J * spread;
    const Scalar mean = A.trace() / Scalar(Axes), least = Scalar(1) / Scalar(16'384);
    Scalar share = A.determinant();
    for (int i = 0; i < Axes; ++i) share /= mean;
    singular = !(share >= least);
    if constexpr (Axes == Joints) {
      if (!singular) {
        J_inverse = Eigen::Matrix<Scalar, Joints, Axes>(J.inverse());
        return;
      }
    }
    if (singular) A.diagonal().array() += mean > Scalar(0) ? mean * (least - std::max(share, Scalar(0))) : Scalar(1);
    J_inverse = spread * A.inverse();
  }
};

}  // namespace detail

/// The dynamics of `robot` at its tip, (2), on task axes.
///
/// With fewer axes than joints J_inverse is H^-1 J^T (J H^-1 J^T)^-1, which moves the tip with the least kinetic energy
/// (Khatib, 1987), M_x = (J H^-1 J^T)^-1, and V_x holds
/// J_inverse^T (C q' + B (q' - J_inverse x')) - M_x J' q': the second part is what friction makes of joint motion that
/// the tip does not show. It vanishes for as many axes as joints, where this is (2) as printed.
///
/// Near a singularity the answer is finite, but J_inverse is damped and (2) holds for it only nearly. A non-finite
/// argument, and with fewer axes than joints a theta whose H is not positive definite, gives a non-finite answer, as in
/// RobotPose, and says so.
/// @param axes     directions of the task axes in the base frame
/// @param coulomb  H(q') of (1), N m, such as the joints' static friction against the sign of their rates
/// @realtime  no allocation, no throw
template <Robot R, int Axes = task_axes<R>>
[[nodiscard]] CartesianDynamics<RobotTraits<R>::joints, Axes, RobotScalar<R>> cartesian_dynamics(
    const R& robot, const RobotParameters<R>& theta, const JointState<RobotTraits<R>::joints, RobotScalar<R>>& is,
    const TaskDirections<Axes, RobotScalar<R>>& axes = TaskDirections<Axes, RobotScalar<R>>::Identity(),
    const JointVector<R>& coulomb = JointVector<R>::Zero()) noexcept {
  static_assert(0 < Axes && Axes <= task_axes<R>, "no more task axes than joints or than directions of space");
  using Scalar = RobotScalar<R>;
  using Task = Eigen::Matrix<Scalar, Axes, RobotTraits<R>::joints>;
  const auto pose = RobotTraits<R>::at(robot, is.q);
  const Task J = axes * pose.jacobian(), Jdot = axes * pose.jacobian_dot(is.qdot);
  const JointMatrix<R> M = pose.H(theta), B = pose.B(theta);
  const detail::TaskInverse<RobotTraits<R>::joints, Axes, Scalar> inverse(J, M);
  const auto& J_inverse = inverse.J_inverse;
  JointVector<R> V = pose.C(theta, is.qdot) * is.qdot;
  if constexpr (Axes < RobotTraits<R>::joints) V += B * (is.qdot - J_inverse * (J * is.qdot));

  CartesianDynamics<RobotTraits<R>::joints, Axes, Scalar> tip;
  tip.J_inverse = J_inverse;
  tip.M_x = J_inverse.transpose() * M * J_inverse;
  tip.V_x = J_inverse.transpose() * V - tip.M_x * (Jdot * is.qdot);
  tip.G_x = J_inverse.transpose() * pose.tau_g(theta);
  tip.B_x = J_inverse.transpose() * B * J_inverse;
  tip.H_x = J_inverse.transpose() * coulomb;
  const bool finite =
      is_finite(tip.M_x) && is_finite(tip.V_x) && is_finite(tip.G_x) && is_finite(tip.B_x) && is_finite(tip.H_x);
  tip.status = finite ? when(inverse.singular, Status::singular) : Status::not_finite;
  return tip;
}

}  // namespace limpid
