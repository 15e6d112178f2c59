// SPDX-License-Identifier: MIT
#include <limpid/robot/joint_state.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_device.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using Eigen::Vector3d;
using limpid::DesiredJoints, limpid::JointState, limpid::Omni, limpid::OmniDevice;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("the defaults are Tables 5.1 and 5.2") {
  const Omni<> omni;
  CHECK(omni.link2() == 0.135);
  CHECK(omni.link3() == 0.130);
  CHECK(omni.gravity() == 9.81);
  Eigen::Matrix<double, 9, 1> theta;
  theta << 3.7e-3, 7.0e-3, 8.0e-3, 0.4e-3, 9.1e-3, 5.2e-3, 0.096, 0.145, 0.055;
  CHECK(Omni<>::table_5_2() == theta);
  const auto limits = omni.limits();
  constexpr double pi = 3.14159265358979323846;
  CHECK(limits.lower == Vector3d(-pi / 3, 0, -2.45));
  CHECK(limits.upper == Vector3d(pi / 3, 1.79, -0.25));
  CHECK(limits.torque == Vector3d(0.30, 0.29, 0.20));
  CHECK(limits.static_friction == Vector3d(0.065, 0.065, 0.028));
  CHECK(Omni<>::elbow_sum_limit() == 0.214);
  CHECK(Omni<>::radius_min() == 0.12);
  CHECK(Omni<>::reach_max() == 0.26);
}

TEST_CASE("the arm stretched to the front reaches both links, and straight up it stands on its axis") {
  const Omni<> omni;
  CHECK(omni.at(Vector3d::Zero()).position() == Vector3d(0.135 + 0.130, 0, 0));
  const Vector3d up = omni.at({0.3, std::acos(0.0), 0}).position();
  CHECK(up.head<2>().norm() < 1e-16);  // 0.265 m times the rounding of pi/2
  CHECK(up[2] == 0.135 + 0.130);
}

TEST_CASE("links and gravity that cannot be are refused with their value") {
  CHECK_THROWS_WITH_AS(Omni<>({.link2 = 0}), "Omni: link2: expected finite and > 0, got 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Omni<>({.link3 = -0.5}), "Omni: link3: expected finite and > 0, got -0.5",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Omni<>({.link3 = infinity}), "Omni: link3: expected finite and > 0, got inf",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Omni<>({.link2 = 1e160}), "Omni: link2: expected a length whose square is in range, got 1e+160",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Omni<>({.link3 = 1e-160}), "Omni: link3: expected a length whose square is in range, got 1e-160",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Omni<>({.gravity = -1}), "Omni: gravity: expected finite and >= 0, got -1",
                       std::invalid_argument);
  CHECK_THROWS_AS(Omni<float>({.gravity = std::numeric_limits<float>::quiet_NaN()}), std::invalid_argument);
}

TEST_CASE("joint angles of the device and of the model are (5.1)") {
  Eigen::Matrix3d turn;
  turn << -1, 0, 0, 0, 1, 0, 0, -1, 1;
  const Vector3d q_omni(0.5, 0.75, 0.25), offset(0, 0, std::acos(0.0));
  CHECK(OmniDevice<>::joints(q_omni) == turn * q_omni - offset);
  CHECK(OmniDevice<>::rates(q_omni) == turn * q_omni);
  CHECK(OmniDevice<>::device_rates(OmniDevice<>::rates(q_omni)) == q_omni);
  CHECK((OmniDevice<>::device_joints(OmniDevice<>::joints(q_omni)) - q_omni).norm() < 1e-15);  // roundings below 4
}

TEST_CASE("gimbal angles and torques of the device and of the model are (5.2) and (5.5)") {
  const Vector3d gimbal(0.1, 0.2, 0.3);
  CHECK(OmniDevice<>::yaw_pitch_roll(gimbal) == Vector3d(0.1, 0.2, -0.3));
  CHECK(OmniDevice<>::device_gimbal(OmniDevice<>::yaw_pitch_roll(gimbal)) == gimbal);
  CHECK(OmniDevice<>::torque({0.1, 0.2, 1}) == Vector3d(-0.1, 0.2, 1.43));
  CHECK(OmniDevice<>::device_torque({0.1, 0.2, 1.43}) == Vector3d(-0.1, 0.2, 1));
}

TEST_CASE("a state of joints is finite when all of it is") {
  JointState<3> state;
  CHECK(limpid::is_finite(state));
  state.qdot[2] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(limpid::is_finite(state));
  DesiredJoints<2, float> desired;
  CHECK(limpid::is_finite(desired));
  desired.qddot[0] = std::numeric_limits<float>::infinity();
  CHECK_FALSE(limpid::is_finite(desired));
}
