// SPDX-License-Identifier: MIT
#include "fifty_digits.hpp"

#include <doctest/doctest.h>

// phi' theta_hat - F cancels terms of 10 N: half a rounding of these is 6e-7 N, which b answers with 3e-5 N s/m where
// the press moves at 0.02 m/s, a millionth and a half of its box. k and c are better known; Gamma shares b's rounding.
// The tolerance is some sixty such roundings, of the few hundred ticks that the law remembers.
TEST_CASE("in float (k, b, c) stays near the law in 50 digits") {
  const auto errors = limpid::stress::law_errors<float>(30'000);
  CHECK(errors.definite);
  MESSAGE("largest errors, parts of the box: k ", errors.theta[0], ", b ", errors.theta[1], ", c ", errors.theta[2],
          "; Gamma ", errors.Gamma);
  for (const double error : errors.theta) CHECK(error < 1e-4);
  CHECK(errors.Gamma < 1e-4);
}
