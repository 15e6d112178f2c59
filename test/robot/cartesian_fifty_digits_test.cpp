// SPDX-License-Identifier: MIT
// (2) and (1) in 50 digits, where their rounding is out of sight and the equations are compared.
#include "cartesian_consistency.hpp"
#include "support/precision.hpp"

#include <doctest/doctest.h>

TEST_CASE("J^T F of (2) is the torque of (1) in 50 digits") {
  limpid::test::check_three_and_two<limpid::test::Fifty>(20, 63);
}
