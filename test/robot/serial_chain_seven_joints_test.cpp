// SPDX-License-Identifier: MIT
#include <limpid/robot/serial_chain.hpp>

#include "chains.hpp"
#include "conformance/robot_suite.hpp"

#include <doctest/doctest.h>

using limpid::test::check_robot, limpid::test::RandomChains;

TEST_CASE("chains of seven joints keep the laws of Robot") {
  RandomChains random(71);
  for (unsigned i = 0; i < 5; ++i) check_robot(random.chain<7>(), random.theta<7>(), i, 5);
  for (unsigned i = 5; i < 10; ++i) check_robot(random.chain<7>(0.4), random.theta<7>(), i, 5);
}
