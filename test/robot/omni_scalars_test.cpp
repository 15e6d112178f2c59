// SPDX-License-Identifier: MIT
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>

#include "conformance/inverse_kinematics_suite.hpp"
#include "conformance/robot_suite.hpp"

#include <doctest/doctest.h>

using limpid::Omni, limpid::OmniKinematics;

static_assert(limpid::InverseKinematics<OmniKinematics<>> && limpid::InverseKinematics<OmniKinematics<float>>);
static_assert(!limpid::InverseKinematics<Omni<>> && !limpid::InverseKinematics<int>);
static_assert(!limpid::Robot<OmniKinematics<>>);

TEST_CASE_TEMPLATE("Omni is a Robot", Scalar, float, long double) {
  limpid::test::check_robot(Omni<Scalar>(), Omni<Scalar>::table_5_2(), 41);
}

TEST_CASE_TEMPLATE("OmniKinematics is InverseKinematics", Scalar, float, double, long double) {
  const Omni<Scalar> robot;
  limpid::test::check_inverse_kinematics(OmniKinematics<Scalar>(robot), robot,
                                         {Scalar(0.25), Scalar(0.75), Scalar(-1.25)});
}
