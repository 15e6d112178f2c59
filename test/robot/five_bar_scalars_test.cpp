// SPDX-License-Identifier: MIT
#include <limpid/robot/five_bar.hpp>
#include <limpid/robot/five_bar_kinematics.hpp>

#include "conformance/inverse_kinematics_suite.hpp"
#include "conformance/robot_suite.hpp"

#include <doctest/doctest.h>

using limpid::FiveBar, limpid::FiveBarKinematics;

TEST_CASE_TEMPLATE("FiveBar is a Robot", Scalar, float, long double) {
  const FiveBar<Scalar> robot;
  limpid::test::check_robot(robot, robot.theta_of({}), 51);
}

TEST_CASE_TEMPLATE("FiveBarKinematics is InverseKinematics", Scalar, float, double, long double) {
  const FiveBar<Scalar> robot;
  limpid::test::check_inverse_kinematics(FiveBarKinematics<Scalar>(robot), robot, {Scalar(1.75), Scalar(0.75)});
}
