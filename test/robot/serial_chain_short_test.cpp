// SPDX-License-Identifier: MIT
#include <limpid/robot/serial_chain.hpp>

#include "chains.hpp"
#include "conformance/robot_suite.hpp"

#include <doctest/doctest.h>

using limpid::test::check_robot, limpid::test::RandomChains;

TEST_CASE("chains of one joint keep the laws of Robot") {
  RandomChains random(21);
  for (unsigned i = 0; i < 5; ++i) check_robot(random.chain<1>(), random.theta<1>(), i, 5);
  check_robot(random.chain<1>(1), random.theta<1>(), 5);
}

TEST_CASE("chains of two joints keep the laws of Robot") {
  RandomChains random(22);
  for (unsigned i = 0; i < 5; ++i) check_robot(random.chain<2>(), random.theta<2>(), i, 5);
  for (unsigned i = 5; i < 10; ++i) check_robot(random.chain<2>(0.5), random.theta<2>(), i, 5);
}
