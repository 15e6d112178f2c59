// SPDX-License-Identifier: MIT
#include <limpid/robot/cartesian_dynamics.hpp>
#include <limpid/robot/five_bar.hpp>
#include <limpid/robot/five_bar_kinematics.hpp>
#include <limpid/robot/omni.hpp>

#include "cartesian_consistency.hpp"
#include "support/no_allocation.hpp"
#include "support/pendulum.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using limpid::cartesian_dynamics, limpid::FiveBar, limpid::Omni, limpid::JointState, limpid::Status;
using limpid::test::check_three_and_two;

TEST_CASE("the five-bar's mass and damping at (0.08, 0.22) are the reference's to the digits printed") {
  const FiveBar<> robot;
  const auto inverse = limpid::FiveBarKinematics<>(robot).inverse({0.08, 0.22, 0});
  CHECK(inverse.status == Status::ok);
  const auto tip = cartesian_dynamics(robot, robot.theta_of({}), JointState<2>{inverse.q});
  Eigen::Matrix2d M, B;
  M << .014848, -.002748, -.002748, .007662;
  B << .045845, -.011546, -.011546, .014866;
  CHECK((tip.M_x - M).cwiseAbs().maxCoeff() < 0.5e-6);  // half a unit of the last digit
  CHECK((tip.B_x - B).cwiseAbs().maxCoeff() < 0.5e-6);
  CHECK(tip.status == Status::ok);
  CHECK(tip.V_x == Eigen::Vector2d::Zero());
  CHECK(tip.G_x == Eigen::Vector2d::Zero());
  CHECK(tip.H_x == Eigen::Vector2d::Zero());
}

TEST_CASE("a pendulum's tip has the mass of its rod's inertia, and feels gravity along its way") {
  // theta = (I, m g, b), 1 m: on the axis (cos q, 0, sin q) J = 1, J' = 0
  const limpid::test::Pendulum<> arm;
  const double c = 0.8, s = 0.6;
  const auto tip = cartesian_dynamics(arm, {0.5, 4, 0.1}, JointState<1>{Eigen::Matrix<double, 1, 1>(std::asin(0.6))},
                                      limpid::TaskDirections<1>(c, 0, s), Eigen::Matrix<double, 1, 1>(0.25));
  CHECK(tip.M_x(0, 0) == doctest::Approx(0.5).epsilon(1e-15));
  CHECK(tip.B_x(0, 0) == doctest::Approx(0.1).epsilon(1e-15));
  CHECK(tip.G_x[0] == doctest::Approx(2.4).epsilon(1e-15));
  CHECK(tip.H_x[0] == doctest::Approx(0.25).epsilon(1e-15));
  CHECK(tip.V_x[0] == 0);
}

TEST_CASE("J^T F of (2) is the torque of (1), for the Omni on three axes and the five-bar on two") {
  check_three_and_two<double>(1000, 61);
  check_three_and_two<float>(1000, 64);
}

TEST_CASE("(3) with the equivalent disturbance is (2), which (4) as printed is not") {
  const FiveBar<> robot({.gravity = {0, -9.81}});
  const Eigen::Vector2d qdot(0.5, -0.25), M_n(0.01, 0.01), B_n(0.022, 0.022), v(0.3, -0.2), a(2, 5);
  const auto tip =
      cartesian_dynamics(robot, robot.theta_of({}), JointState<2>{{1.75, 0.75}, qdot},
                         limpid::TaskDirections<2>(limpid::TaskDirections<2>::Identity()), {0.002, -0.003});
  const Eigen::Vector2d F_xd = tip.equivalent_disturbance(M_n, B_n, v, a);
  const Eigen::Vector2d F = M_n.cwiseProduct(a) + B_n.cwiseProduct(v) + F_xd;  // (3)
  CHECK((F - tip.force(v, a)).cwiseAbs().maxCoeff() < 1e-15);
  const Eigen::Vector2d printed = tip.M_x * a - M_n.cwiseProduct(a) + tip.V_x + tip.G_x + tip.H_x;  // (4)
  CHECK((F_xd - printed - (tip.B_x * v - B_n.cwiseProduct(v))).cwiseAbs().maxCoeff() < 1e-15);
  CHECK((F_xd - printed).norm() > 1e-3);
}

TEST_CASE("a singular pose is told, and its answer is bounded") {
  const Omni<> omni;
  for (const double gap : {0.0, 1e-300, 1e-12, 1e-6, 1e-3}) {  // stretched, or nearly
    const auto tip = cartesian_dynamics(omni, Omni<>::table_5_2(), JointState<3>{{0.2, 0.7, -gap}, {1, -1, 1}});
    CHECK(tip.status == Status::singular);
    CHECK(tip.J_inverse.norm() < 1e4);  // rad/m; half the root of 2^14 per 0.1 m
    CHECK((tip.M_x.allFinite() && tip.V_x.allFinite() && tip.G_x.allFinite() && tip.B_x.allFinite()));
  }
  CHECK(cartesian_dynamics(omni, Omni<>::table_5_2(), JointState<3>{{0.2, 0.7, -1.2}, {1, -1, 1}}).status ==
        Status::ok);
}

TEST_CASE("a tip that cannot move along any task axis is singular, and its answer is finite") {
  const limpid::test::Pendulum<> arm;  // at q = 0 it moves along x
  const JointState<1> still{Eigen::Matrix<double, 1, 1>(0.0), Eigen::Matrix<double, 1, 1>(1.0)};
  const auto along = cartesian_dynamics(arm, {0.5, 4, 0.1}, still, limpid::TaskDirections<1>(0, 0, 1));
  CHECK(along.status == Status::singular);
  CHECK(along.J_inverse(0, 0) == 0);
  CHECK(std::isfinite(along.force(Eigen::Matrix<double, 1, 1>(1.0), Eigen::Matrix<double, 1, 1>(1.0))[0]));
}

TEST_CASE("an answer that is not finite says so") {
  const FiveBar<> robot;
  const auto theta = robot.theta_of({});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(cartesian_dynamics(robot, theta, JointState<2>{{nan, 0.7}, {0, 0}}).status == Status::not_finite);
  CHECK(cartesian_dynamics(robot, theta, JointState<2>{{1.7, 0.7}, {0, nan}}).status == Status::not_finite);
  CHECK(cartesian_dynamics(robot, theta, JointState<2>{{3.0, 0.1}, {0, 0}}).status == Status::not_finite);  // open
}

TEST_CASE("nothing allocates") {
  const Omni<> omni;
  const FiveBar<> five_bar;
  const auto theta = five_bar.theta_of({});
  double kept = 0;
  limpid::test::check_no_allocation([&] {
    kept += cartesian_dynamics(omni, Omni<>::table_5_2(), JointState<3>{{0.2, 0.7, -1.2}, {1, 1, 1}}).M_x.sum();
    kept += cartesian_dynamics(omni, Omni<>::table_5_2(), JointState<3>{{0.2, 0.7, 0}, {1, 1, 1}}).M_x.sum();
    kept += cartesian_dynamics(five_bar, theta, JointState<2>{{1.7, 0.7}, {1, 1}}).M_x.sum();
  });
  CHECK(std::isfinite(kept));
}
