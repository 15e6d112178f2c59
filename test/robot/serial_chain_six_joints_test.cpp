// SPDX-License-Identifier: MIT
#include <limpid/robot/serial_chain.hpp>

#include "chains.hpp"
#include "conformance/robot_suite.hpp"

#include <doctest/doctest.h>

#include <cmath>

using limpid::test::check_robot, limpid::test::puma_560, limpid::test::puma_560_theta, limpid::test::RandomChains;

namespace {

using Six = Eigen::Matrix<double, 6, 1>;

/// Gravity torques of the paper's section 4, with its constants g1 to g5 from the masses, centres and lengths.
Six paper_gravity(const Six& q) {
  const double g = 9.81, a2 = 0.4318, a3 = -0.0203, d4 = 0.4331, wrist = 0.82 + 0.34 + 0.09;
  const double g1 = -g * ((4.80 + wrist) * a2 + 17.40 * 0.068);
  const double g2 = g * (4.80 * -0.070 - wrist * d4 - 0.82 * -0.019);
  const double g3 = g * 17.40 * 0.006;
  const double g4 = -g * wrist * a3;
  const double g5 = -g * 0.09 * 0.032;
  const double s23 = std::sin(q[1] + q[2]), c23 = std::cos(q[1] + q[2]);
  const double c4 = std::cos(q[3]), s4 = std::sin(q[3]), c5 = std::cos(q[4]), s5 = std::sin(q[4]);
  const double forearm = g2 * s23 + g4 * c23 + g5 * (s23 * c5 + c23 * c4 * s5);
  Six tau;
  tau << 0, g1 * std::cos(q[1]) + g3 * std::sin(q[1]) + forearm, forearm, -g5 * s23 * s4 * s5,
      g5 * (c23 * s5 + s23 * c4 * c5), 0;
  return tau;
}

}  // namespace

TEST_CASE("chains of six joints keep the laws of Robot") {
  RandomChains random(61);
  for (unsigned i = 0; i < 5; ++i) check_robot(random.chain<6>(), random.theta<6>(), i, 5);
  for (unsigned i = 5; i < 10; ++i) check_robot(random.chain<6>(0.4), random.theta<6>(), i, 5);
}

TEST_CASE("the PUMA 560 keeps them too") { check_robot(puma_560(), puma_560_theta(), 560); }

TEST_CASE("the PUMA 560 weighs on its joints what its paper says") {
  RandomChains random(62);
  for (int i = 0; i < 100; ++i) {
    CAPTURE(i);
    const Six q = random.joints<6>(-3, 3);
    const Six expected = paper_gravity(q), actual = puma_560().at(q).tau_g(puma_560_theta());
    CHECK((actual - expected).cwiseAbs().maxCoeff() < 1e-13);  // roundings of 60 N m
  }
  // The constants as the paper prints them, with their tolerances: g1 of the arm lying, g2 of the forearm lying.
  Six lying = Six::Zero();
  CHECK(std::abs(puma_560().at(lying).tau_g(puma_560_theta())[1] - (-37.2 + 0.249)) < 0.5 + 0.025);
  lying[2] = std::acos(0.0);
  CHECK(std::abs(puma_560().at(lying).tau_g(puma_560_theta())[2] - (-8.44 - 0.0282)) < 0.20 + 0.0056);
}
