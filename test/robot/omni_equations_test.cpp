// SPDX-License-Identifier: MIT
// Omni against the thesis's equations as they are printed, on 1e5 random states: rates up to 5 rad/s, accelerations up
// to 50 rad/s^2, entries up to 250, of which 1e-12 is twenty roundings.
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>

#include "omni_states.hpp"
#include "worst.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using Eigen::Matrix3d, Eigen::Matrix4d, Eigen::Vector3d;
using limpid::Omni;
using limpid::test::OmniState, limpid::test::OmniStates, limpid::test::Worst;
using Regressor = Eigen::Matrix<double, 3, 9>;
using Parameters = Eigen::Matrix<double, 9, 1>;

namespace {

constexpr int states = 100'000;
constexpr double tolerance = 1e-12;
constexpr double l2 = 0.135, l3 = 0.130, g = 9.81;  // Table 5.2

/// The substitutions of section 3.3.
struct Substitutions {
  explicit Substitutions(const Vector3d& q)
      : c1{std::cos(q[0])},
        s1{std::sin(q[0])},
        c2{std::cos(q[1])},
        s2{std::sin(q[1])},
        c3{std::cos(q[2])},
        s3{std::sin(q[2])},
        c23{std::cos(q[1] + q[2])},
        s23{std::sin(q[1] + q[2])},
        s223{std::sin(2 * q[1] + q[2])},
        r{l2 * c2 + l3 * c23},
        z{l2 * s2 + l3 * s23} {}
  double c1, s1, c2, s2, c3, s3, c23, s23, s223, r, z;
};

Matrix3d printed_jacobian(const Substitutions& k) {  // (3.9)
  const auto& [c1, s1, c2, s2, c3, s3, c23, s23, s223, r, z] = k;
  Matrix3d J;
  J << -r * s1, -z * c1, -l3 * c1 * s23, r * c1, -z * s1, -l3 * s1 * s23, 0, r, l3 * c23;
  return J;
}

Matrix3d printed_jacobian_dot(const Substitutions& k, const Vector3d& qdot) {  // (3.11)
  const auto& [c1, s1, c2, s2, c3, s3, c23, s23, s223, r, z] = k;
  Eigen::Matrix<double, 9, 3> tall;
  tall << -r * c1, z * s1, l3 * s1 * s23,             //
      z * s1, -r * c1, -l3 * c1 * c23,                //
      l3 * s1 * s23, -l3 * c1 * c23, -l3 * c1 * c23,  //
      r * s1, z * c1, l3 * c1 * s23,                  //
      z * c1, r * s1, l3 * s1 * c23,                  //
      l3 * c1 * s23, l3 * s1 * c23, l3 * s1 * c23,    //
      0, 0, 0,                                        //
      0, z, l3 * s23,                                 //
      0, l3 * s23, l3 * s23;
  Eigen::Matrix<double, 3, 9> wide = Eigen::Matrix<double, 3, 9>::Zero();
  wide.block<1, 3>(0, 0) = qdot.transpose();
  wide.block<1, 3>(1, 3) = -qdot.transpose();
  wide.block<1, 3>(2, 6) = -qdot.transpose();
  return wide * tall;
}

Matrix3d printed_inverse_jacobian(const Substitutions& k) {  // (3.13)
  const auto& [c1, s1, c2, s2, c3, s3, c23, s23, s223, r, z] = k;
  Matrix3d inverse;
  inverse << -s1 / r, c1 / r, 0,                                    //
      c1 * c23 / (l2 * s3), s1 * c23 / (l2 * s3), s23 / (l2 * s3),  //
      -r * c1 / (l2 * l3 * s3), -r * s1 / (l2 * l3 * s3), -z / (l2 * l3 * s3);
  return inverse;
}

Regressor printed_regressor(const Substitutions& k, const Vector3d& qdot, const Vector3d& qddot) {  // (3.26), corrected
  const auto& [c1, s1, c2, s2, c3, s3, c23, s23, s223, r, z] = k;
  const double q1 = qdot[0], q2 = qdot[1], q3 = qdot[2], a1 = qddot[0], a2 = qddot[1], a3 = qddot[2];
  Regressor phi = Regressor::Zero();
  phi.row(0) << a1, c2 * c2 * a1 - 2 * c2 * s2 * q1 * q2, c23 * c23 * a1 - c23 * s23 * (2 * q2 + 2 * q3) * q1,
      2 * c2 * c23 * a1 - 2 * (s223 * q2 + c2 * s23 * q3) * q1, 0, 0, q1, 0, 0;
  phi.row(1) << 0, a2 + c2 * s2 * q1 * q1, a2 + a3 + c23 * s23 * q1 * q1,
      2 * c3 * a2 + c3 * a3 + s223 * q1 * q1 - s3 * (2 * q2 + q3) * q3, g * c2, g * c23, 0, q2, 0;
  phi.row(2) << 0, 0, a2 + a3 + c23 * s23 * q1 * q1, c3 * a2 + c2 * s23 * q1 * q1 + s3 * q2 * q2, 0, g * c23, 0, 0, q3;
  return phi;
}

Regressor printed_reference_regressor(const Substitutions& k, const Vector3d& qdot, const Vector3d& qdot_r,
                                      const Vector3d& qddot_r) {  // (3.28)
  const auto& [c1, s1, c2, s2, c3, s3, c23, s23, s223, r, z] = k;
  const double q1 = qdot[0], q2 = qdot[1], q3 = qdot[2], v1 = qdot_r[0], v2 = qdot_r[1], v3 = qdot_r[2];
  const double a1 = qddot_r[0], a2 = qddot_r[1], a3 = qddot_r[2];
  Regressor phi = Regressor::Zero();
  phi.row(0) << a1, c2 * c2 * a1 - c2 * s2 * (q2 * v1 + q1 * v2),
      c23 * c23 * a1 - c23 * s23 * (v1 * (q2 + q3) + q1 * (v2 + v3)),
      2 * c2 * c23 * a1 - s223 * (v1 * q2 + q1 * v2) - c2 * s23 * (v1 * q3 + q1 * v3), 0, 0, v1, 0, 0;
  phi.row(1) << 0, a2 + c2 * s2 * q1 * v1, a2 + a3 + c23 * s23 * q1 * v1,
      2 * c3 * a2 + c3 * a3 + s223 * q1 * v1 - s3 * ((v2 + v3) * q3 + q2 * v3), g * c2, g * c23, 0, v2, 0;
  phi.row(2) << 0, 0, a2 + a3 + c23 * s23 * q1 * v1, c3 * a2 + c2 * s23 * q1 * v1 + s3 * q2 * v2, 0, g * c23, 0, 0, v3;
  return phi;
}

Matrix4d link_transform(double angle, double length, double twist) {  // standard Denavit-Hartenberg, d = 0
  const double c = std::cos(angle), s = std::sin(angle), ct = std::cos(twist), st = std::sin(twist);
  Matrix4d T;
  T << c, -s * ct, s * st, length * c, s, c * ct, -c * st, length * s, 0, st, ct, 0, 0, 0, 0, 1;
  return T;
}

}  // namespace

TEST_CASE("the tip is where the Denavit-Hartenberg parameters of Table 3.1 put it") {
  OmniStates random(32);
  Worst worst;
  for (int i = 0; i < states; ++i) {
    const Vector3d q = random().q;
    const Matrix4d T =
        link_transform(q[0], 0, std::acos(0.0)) * link_transform(q[1], l2, 0) * link_transform(q[2], l3, 0);
    worst.see(Omni<>().at(q).position() - T.block<3, 1>(0, 3), i);
  }
  CAPTURE(worst);
  CHECK(worst.error() < 1e-15);  // lengths below 0.265 m, some ten roundings
}

TEST_CASE("J, its derivative and its inverse are (3.9), (3.11) and (3.13)") {
  OmniStates random(39);
  const Omni<> robot;
  const limpid::OmniKinematics<> kinematics(robot);
  Worst jacobian, jacobian_dot, inverse, identity;
  for (int i = 0; i < states; ++i) {
    const OmniState state = random();
    const Substitutions k(state.q);
    const auto pose = robot.at(state.q);
    Matrix3d columns;
    for (int j = 0; j < 3; ++j) {
      columns.col(j) = kinematics.inverse(pose.position(), Vector3d::Unit(j), Vector3d::Zero()).qdot;
    }
    jacobian.see(pose.jacobian() - printed_jacobian(k), i);
    jacobian_dot.see(pose.jacobian_dot(state.qdot) - printed_jacobian_dot(k, state.qdot), i);
    inverse.see(columns - printed_inverse_jacobian(k), i);
    identity.see(columns * pose.jacobian() - Matrix3d::Identity(), i);
  }
  CAPTURE(jacobian);
  CAPTURE(jacobian_dot);
  CAPTURE(inverse);
  CAPTURE(identity);
  CHECK(jacobian.error() < tolerance);
  CHECK(jacobian_dot.error() < tolerance);
  CHECK(inverse.error() < tolerance);
  CHECK(identity.error() < tolerance);
}

TEST_CASE("both regressors are (3.26) and (3.28), and their products leave out only zeros") {
  OmniStates random(326);
  const Omni<> robot;
  const Parameters theta = Omni<>::table_5_2();
  Worst motion, reference, torque, direction, parts;
  for (int i = 0; i < states; ++i) {
    const OmniState state = random(), other = random();
    const Vector3d &qdot = state.qdot, &qdot_r = other.qdot, &qddot_r = other.qddot, &delta = state.qddot;
    const Substitutions k(state.q);
    const auto pose = robot.at(state.q);
    const Regressor phi_r = pose.regressor(qdot, qdot_r, qddot_r);
    const auto largest = [](const auto& difference) { return limpid::test::largest_entry(difference); };
    motion.see(largest(pose.regressor(qdot, state.qddot) - printed_regressor(k, qdot, state.qddot)), i);
    reference.see(largest(phi_r - printed_reference_regressor(k, qdot, qdot_r, qddot_r)), i);
    torque.see(largest(pose.torque(theta, qdot, qdot_r, qddot_r) - phi_r * theta), i);
    direction.see(largest(pose.adaptation_direction(qdot, qdot_r, qddot_r, delta) - phi_r.transpose() * delta) / 1e4,
                  i);
    parts.see(largest(phi_r * theta - pose.H(theta) * qddot_r - (pose.C(theta, qdot) + pose.B(theta)) * qdot_r -
                      pose.tau_g(theta)),
              i);  // (3.27)
  }
  CAPTURE(motion);
  CAPTURE(reference);
  CAPTURE(torque);
  CAPTURE(direction);
  CAPTURE(parts);
  CHECK(motion.error() < tolerance);
  CHECK(reference.error() < tolerance);
  CHECK(torque.error() < tolerance);
  CHECK(direction.error() < tolerance);  // of 1e4: regressor entries up to 200 times delta up to 50
  CHECK(parts.error() < tolerance);
}

TEST_CASE("the inertia of Table 5.2 is positive definite within Table 5.1, its least eigenvalue 2.64e-3") {
  const Omni<> robot;
  const Parameters theta = Omni<>::table_5_2();
  double least = 1;
  for (double q2 = 0; q2 <= 1.79; q2 += 0.005) {
    for (double q3 = -2.45; q3 < -0.2499; q3 += 0.005) {
      const auto pose = robot.at({0, q2, q3});
      const Matrix3d H = pose.H(theta);
      const double half_trace = (H(1, 1) + H(2, 2)) / 2;
      const double least_of_two =  // of the block of joints 2 and 3
          half_trace - std::sqrt(half_trace * half_trace - H(1, 1) * H(2, 2) + H(1, 2) * H(2, 1));
      least = std::min({least, H(0, 0), least_of_two});
    }
  }
  CHECK(std::abs(least - 2.64e-3) < 5e-6);  // the figure has three digits
}
