// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/robot/robot.hpp>

#include "support/no_allocation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

namespace limpid::test {

/// The laws of the concept Robot, for any type: `check_robot(robot, theta, seed)` with a theta that could be a body's.
///
/// Derivatives are differences of fourth order over a step of eps^(1/5), which leave some ten eps^(4/5) of the values.
template <Robot R>
class RobotSuite {
 public:
  using Scalar = RobotScalar<R>;
  using Joints = JointVector<R>;
  using Parameters = RobotParameters<R>;
  static constexpr int n = RobotTraits<R>::joints;

  RobotSuite(const R& robot, const Parameters& theta, unsigned seed) : robot_{robot}, theta_{theta}, random_{seed} {
    using std::pow;
    step_ = pow(std::numeric_limits<Scalar>::epsilon(), Scalar(1) / Scalar(5));
    coarse_ = 100 * pow(std::numeric_limits<Scalar>::epsilon(), Scalar(4) / Scalar(5));
    fine_ = 1000 * std::numeric_limits<Scalar>::epsilon();
  }

  void check_limits() const {
    const auto limits = RobotTraits<R>::limits(robot_);
    CHECK((limits.lower.array() < limits.upper.array()).all());
    CHECK((limits.torque.array() > Scalar(0)).all());
    CHECK((limits.static_friction.array() >= Scalar(0)).all());
  }

  /// J is the derivative of the position, J' that of J.
  void check_kinematics() {
    const Joints q = inside(), qdot = rates();
    const auto pose = at(q);
    const JacobianMatrix<R> J = pose.jacobian(), Jdot = pose.jacobian_dot(qdot);
    JacobianMatrix<R> differences;
    for (int j = 0; j < n; ++j) {
      differences.col(j) = derivative([&](const Scalar& s) { return Point(at(q + Joints::Unit(j) * s).position()); });
    }
    check_near(J, differences, coarse_);
    check_near(Jdot, derivative([&](const Scalar& s) { return JacobianMatrix<R>(at(q + qdot * s).jacobian()); }),
               coarse_);
  }

  /// Properties 1 and 2; C q' and tau_g are what Lagrange's equation (3.20) makes of H and of a potential.
  void check_dynamics() {
    const Joints q = inside(), qdot = rates();
    const JointMatrix<R> H = at(q).H(theta_), C = at(q).C(theta_, qdot), B = at(q).B(theta_);
    const JointMatrix<R> Hdot = derivative([&](const Scalar& s) { return JointMatrix<R>(at(q + qdot * s).H(theta_)); });
    CHECK((H.array() == H.transpose().array()).all());
    CHECK(Eigen::LLT<JointMatrix<R>>(H).info() == Eigen::Success);
    check_near(Hdot, JointMatrix<R>(C + C.transpose()), coarse_);
    CHECK((B.diagonal().array() >= Scalar(0)).all());
    Joints kinetic_slope;
    JointMatrix<R> gravity_slope;
    for (int j = 0; j < n; ++j) {
      const auto aside = [&](const Scalar& s) { return at(q + Joints::Unit(j) * s); };
      kinetic_slope[j] = derivative([&](const Scalar& s) {
        return Eigen::Matrix<Scalar, 1, 1>(qdot.dot(aside(s).H(theta_) * qdot) / Scalar(2));
      })[0];
      gravity_slope.col(j) = derivative([&](const Scalar& s) { return Joints(aside(s).tau_g(theta_)); });
    }
    check_near(Joints(C * qdot), Joints(Hdot * qdot - kinetic_slope), coarse_);
    check_near(gravity_slope, JointMatrix<R>(gravity_slope.transpose()), coarse_);
  }

  /// (3.16), (3.27), and the products that need no phi_r.
  void check_regressors() {
    const auto pose = at(inside());
    const Joints qdot = rates(), qdot_r = rates(), qddot_r = rates(), delta = rates();
    const RegressorMatrix<R> phi_r = pose.regressor(qdot, qdot_r, qddot_r);
    const JointMatrix<R> velocity = JointMatrix<R>(pose.C(theta_, qdot)) + JointMatrix<R>(pose.B(theta_));
    check_near(Joints(phi_r * theta_), Joints(pose.H(theta_) * qddot_r + velocity * qdot_r + pose.tau_g(theta_)),
               fine_);
    check_near(RegressorMatrix<R>(pose.regressor(qdot, qddot_r)),
               RegressorMatrix<R>(pose.regressor(qdot, qdot, qddot_r)), fine_);
    check_near(Joints(pose.torque(theta_, qdot, qdot_r, qddot_r)), Joints(phi_r * theta_), fine_);
    check_near(Parameters(pose.adaptation_direction(qdot, qdot_r, qddot_r, delta)),
               Parameters(phi_r.transpose() * delta), fine_);
  }

  void check_not_finite() {
    const Joints q = inside(), qdot = rates();
    for (int j = 0; j < n; ++j) {
      Joints broken = q;
      broken[j] = std::numeric_limits<Scalar>::quiet_NaN();
      CHECK_FALSE(is_finite(Point(at(broken).position())));
      broken = qdot;
      broken[j] = std::numeric_limits<Scalar>::infinity();
      CHECK_FALSE(is_finite(Joints(at(q).torque(theta_, broken, broken, broken))));
    }
  }

  void check_allocation() {
    const Joints q = inside(), qdot = rates();
    check_no_allocation([&] {
      const auto pose = at(q);
      const Joints torque = pose.torque(theta_, qdot, qdot, qdot);
      const Parameters direction = pose.adaptation_direction(qdot, qdot, qdot, torque);
      const JacobianMatrix<R> J = pose.jacobian(), Jdot = pose.jacobian_dot(qdot);
      const JointMatrix<R> H = pose.H(direction), C = pose.C(direction, qdot), B = pose.B(direction);
      const RegressorMatrix<R> phi = pose.regressor(qdot, qdot, qdot);
      kept_ = J.sum() + Jdot.sum() + H.sum() + C.sum() + B.sum() + phi.sum();
    });
  }

 private:
  using Point = Eigen::Matrix<Scalar, 3, 1>;

  [[nodiscard]] auto at(const Joints& q) const { return RobotTraits<R>::at(robot_, q); }

  [[nodiscard]] Joints inside() {
    const auto limits = RobotTraits<R>::limits(robot_);
    Joints q;
    for (int j = 0; j < n; ++j) q[j] = limits.lower[j] + (limits.upper[j] - limits.lower[j]) * Scalar(uniform(0, 1));
    return q;
  }
  [[nodiscard]] Joints rates() {
    Joints qdot;
    for (int j = 0; j < n; ++j) qdot[j] = Scalar(uniform(-1, 1));
    return qdot;
  }
  [[nodiscard]] double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  /// df/ds at s = 0.
  [[nodiscard]] auto derivative(const auto& f) const {
    const auto near = (f(step_) - f(Scalar(-step_))).eval(), far = (f(2 * step_) - f(Scalar(-2 * step_))).eval();
    return ((8 * near - far) / (12 * step_)).eval();
  }

  static void check_near(const auto& actual, const auto& expected, const Scalar& tolerance) {
    const auto scale = static_cast<double>(expected.cwiseAbs().maxCoeff()) + 1;
    const auto error = static_cast<double>((actual - expected).cwiseAbs().maxCoeff());
    CHECK(error <= static_cast<double>(tolerance) * scale);
  }

  R robot_;
  Parameters theta_;
  std::mt19937 random_;
  Scalar step_, coarse_, fine_;
  Scalar kept_{0};  // what the allocation test computes, so that it is computed
};

/// All laws, at `poses` random poses.
template <Robot R>
void check_robot(const R& robot, const RobotParameters<R>& theta, unsigned seed, int poses = 20) {
  CAPTURE(seed);
  RobotSuite<R> suite(robot, theta, seed);
  suite.check_limits();
  for (int i = 0; i < poses; ++i) {
    CAPTURE(i);
    suite.check_kinematics();
    suite.check_dynamics();
    suite.check_regressors();
  }
  suite.check_not_finite();
  suite.check_allocation();
}

}  // namespace limpid::test
