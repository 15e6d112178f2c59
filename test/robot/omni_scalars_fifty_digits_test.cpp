// SPDX-License-Identifier: MIT
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>

#include "conformance/inverse_kinematics_suite.hpp"
#include "conformance/robot_suite.hpp"
#include "support/precision.hpp"

#include <doctest/doctest.h>

using limpid::Omni, limpid::OmniKinematics, limpid::test::Fifty;

TEST_CASE("Omni in 50 digits is a Robot to 40 of them") {
  limpid::test::check_robot(Omni<Fifty>(), Omni<Fifty>::table_5_2(), 51);
}

TEST_CASE("OmniKinematics in 50 digits is InverseKinematics to 47 of them") {
  const Omni<Fifty> robot;
  limpid::test::check_inverse_kinematics(OmniKinematics<Fifty>(robot), robot, {Fifty(0.25), Fifty(0.75), Fifty(-1.25)});
}
