// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/finite.hpp>
#include <limpid/robot/robot.hpp>

#include "support/no_allocation.hpp"

#include <Eigen/Core>

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <span>

namespace limpid::test {

/// The laws of the concept Robot, for any type: `check_robot(robot, theta, seed)` with a theta that could be a body's.
///
/// Derivatives are differences of fourth order over a step of eps^(1/5), which leave some ten eps^(4/5) of the values.
/// Loops over entries, not expressions, which a compiler would have to make anew for each robot and scalar.
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
    for (int j = 0; j < n; ++j) {
      CHECK(bool(limits.lower[j] < limits.upper[j]));
      CHECK(bool(limits.torque[j] > Scalar(0)));
      CHECK(bool(limits.static_friction[j] >= Scalar(0)));
    }
  }

  /// J is the derivative of the position, J' that of J.
  void check_kinematics() {
    const Joints q = inside(), qdot = rates();
    const auto pose = at(q);
    const JacobianMatrix<R> J = pose.jacobian(), Jdot = pose.jacobian_dot(qdot);
    JacobianMatrix<R> differences;
    for (int j = 0; j < n; ++j) {
      const Point column = derivative([&](const Scalar& s) { return Point(aside(q, j, s).position()); });
      for (int i = 0; i < 3; ++i) differences(i, j) = column[i];
    }
    check_near(J, differences, coarse_);
    check_near(Jdot, derivative([&](const Scalar& s) { return JacobianMatrix<R>(along(q, qdot, s).jacobian()); }),
               coarse_);
  }

  /// Properties 1 and 2; C q' and tau_g are what Lagrange's equation (3.20) makes of H and of a potential.
  void check_dynamics() {
    const Joints q = inside(), qdot = rates();
    const JointMatrix<R> H = at(q).H(theta_), C = at(q).C(theta_, qdot), B = at(q).B(theta_);
    const JointMatrix<R> Hdot =
        derivative([&](const Scalar& s) { return JointMatrix<R>(along(q, qdot, s).H(theta_)); });
    CHECK(is_symmetric(H));
    CHECK(is_positive_definite(H));
    JointMatrix<R> twice_symmetric_C, gravity_slope, gravity_slope_transposed;
    Joints force = product(Hdot, qdot);
    for (int j = 0; j < n; ++j) {
      CHECK(bool(B(j, j) >= Scalar(0)));
      const JointMatrix<R> H_slope =
          derivative([&](const Scalar& s) { return JointMatrix<R>(aside(q, j, s).H(theta_)); });
      const Joints column = derivative([&](const Scalar& s) { return Joints(aside(q, j, s).tau_g(theta_)); });
      const Joints momentum_slope = product(H_slope, qdot);
      for (int i = 0; i < n; ++i) {
        twice_symmetric_C(i, j) = C(i, j) + C(j, i);
        gravity_slope(i, j) = gravity_slope_transposed(j, i) = column[i];
        force[j] -= qdot[i] * momentum_slope[i] / Scalar(2);  // of the kinetic energy
      }
    }
    check_near(Hdot, twice_symmetric_C, coarse_);
    check_near(product(C, qdot), force, coarse_);
    check_near(gravity_slope, gravity_slope_transposed, coarse_);
  }

  /// (3.16), (3.27), and the products that need no phi_r.
  void check_regressors() {
    const auto pose = at(inside());
    const Joints qdot = rates(), qdot_r = rates(), qddot_r = rates(), delta = rates();
    const RegressorMatrix<R> phi_r = pose.regressor(qdot, qdot_r, qddot_r);
    const JointMatrix<R> H = pose.H(theta_), C = pose.C(theta_, qdot), B = pose.B(theta_);
    const Joints torque = product(phi_r, theta_), gravity = pose.tau_g(theta_);
    Joints expected;
    Parameters direction;
    for (int i = 0; i < n; ++i) {
      expected[i] = gravity[i];
      for (int j = 0; j < n; ++j) expected[i] += H(i, j) * qddot_r[j] + (C(i, j) + B(i, j)) * qdot_r[j];
    }
    for (int i = 0; i < RobotTraits<R>::parameters; ++i) {
      direction[i] = Scalar(0);
      for (int j = 0; j < n; ++j) direction[i] += phi_r(j, i) * delta[j];
    }
    check_near(torque, expected, fine_);
    check_near(RegressorMatrix<R>(pose.regressor(qdot, qddot_r)),
               RegressorMatrix<R>(pose.regressor(qdot, qdot, qddot_r)), fine_);
    check_near(Joints(pose.torque(theta_, qdot, qdot_r, qddot_r)), torque, fine_);
    check_near(Parameters(pose.adaptation_direction(qdot, qdot_r, qddot_r, delta)), direction, fine_);
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
      kept_ = Scalar(0);
      for (const Entries each : {entries(J), entries(Jdot), entries(H), entries(C), entries(B), entries(phi)}) {
        for (const Scalar& entry : each) kept_ += entry;
      }
    });
  }

 private:
  using Point = Eigen::Matrix<Scalar, 3, 1>;

  using Entries = std::span<const Scalar>;

  [[nodiscard]] auto at(const Joints& q) const { return RobotTraits<R>::at(robot_, q); }
  [[nodiscard]] auto aside(Joints q, int joint, const Scalar& s) const {
    q[joint] += s;
    return at(q);
  }
  [[nodiscard]] auto along(Joints q, const Joints& qdot, const Scalar& s) const {
    for (int j = 0; j < n; ++j) q[j] += qdot[j] * s;
    return at(q);
  }

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
  template <typename F>
  [[nodiscard]] auto derivative(const F& f) const {
    using Value = decltype(f(step_));
    const Value ahead = f(step_), behind = f(Scalar(-step_));
    const Value far_ahead = f(Scalar(2 * step_)), far_behind = f(Scalar(-2 * step_));
    Value slope;
    for (Eigen::Index i = 0; i < slope.size(); ++i) {
      const Scalar near = ahead.data()[i] - behind.data()[i], far = far_ahead.data()[i] - far_behind.data()[i];
      slope.data()[i] = (8 * near - far) / (12 * step_);
    }
    return slope;
  }

  template <int columns>
  [[nodiscard]] static Joints product(const Eigen::Matrix<Scalar, n, columns>& A,
                                      const Eigen::Matrix<Scalar, columns, 1>& x) {
    Joints y;
    for (int i = 0; i < n; ++i) {
      y[i] = Scalar(0);
      for (int j = 0; j < columns; ++j) y[i] += A(i, j) * x[j];
    }
    return y;
  }

  [[nodiscard]] static bool is_symmetric(const JointMatrix<R>& A) {
    bool same = true;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < i; ++j) same = same && A(i, j) == A(j, i);
    }
    return same;
  }

  [[nodiscard]] static bool is_positive_definite(JointMatrix<R> A) {
    for (int j = 0; j < n; ++j) {
      if (!(A(j, j) > Scalar(0))) return false;
      for (int i = j + 1; i < n; ++i) {
        const Scalar factor = A(i, j) / A(j, j);
        for (int k = j + 1; k <= i; ++k) A(i, k) -= factor * A(k, j);
      }
    }
    return true;
  }

  template <int rows, int columns>
  [[nodiscard]] static Entries entries(const Eigen::Matrix<Scalar, rows, columns>& A) {
    return {A.data(), static_cast<std::size_t>(rows * columns)};
  }

  /// Of matrices of one type.
  template <typename Matrix>
  static void check_near(const Matrix& actual, const Matrix& expected, const Scalar& tolerance) {
    check_entries(entries(actual), entries(expected), tolerance);
  }
  static void check_entries(Entries actual, Entries expected, const Scalar& tolerance) {
    using std::abs;
    double scale = 1, error = 0;
    for (std::size_t i = 0; i < actual.size(); ++i) {
      const double size = static_cast<double>(Scalar(abs(expected[i])));
      const double difference = static_cast<double>(Scalar(abs(actual[i] - expected[i])));
      if (size + 1 > scale) scale = size + 1;
      if (difference > error || std::isnan(difference)) error = difference;  // and stays NaN
    }
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
