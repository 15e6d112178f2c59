// SPDX-License-Identifier: MIT
#include <limpid/prediction/hold_predictor.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <limits>

using limpid::HoldPredictor;
using limpid::Status;
using namespace std::chrono_literals;
using One = Eigen::Array<double, 1, 1>;

TEST_CASE("the newest sample is held with its velocity and acceleration") {
  HoldPredictor<1> hold({.start = {.x = One::Constant(0.5)}});
  auto [start, status] = hold.advance(0ms, One::Zero());
  CHECK(start.x[0] == 0.5);
  CHECK(status == Status::no_sample);
  CHECK(hold.observe({{One::Constant(1), One::Constant(2), One::Constant(3), One::Constant(4)}, 0ms, 5ms}) ==
        Status::ok);
  for (const auto now : {5ms, 6ms, 50ms}) {
    const auto [motion, held] = hold.advance(now, One::Constant(7));
    CHECK(motion.x[0] == 1);
    CHECK(motion.v[0] == 2);
    CHECK(motion.a[0] == 3);
    CHECK(held == Status::ok);
  }
}

TEST_CASE("a start that is not finite is refused") {
  CHECK_THROWS_WITH_AS(HoldPredictor<1>({.start = {.x = One::Constant(std::numeric_limits<double>::quiet_NaN())}}),
                       "HoldPredictor: start: expected finite, got a motion that is not", std::invalid_argument);
}

TEST_CASE("a sample observed is held from the next tick on") {
  HoldPredictor<1> hold;
  (void)hold.advance(0ms, One::Zero());
  CHECK(hold.observe({{One::Constant(1), One::Zero(), One::Zero(), One::Zero()}, 0ms, 1ms}) == Status::ok);
  CHECK(hold.advance(0ms, One::Zero()).motion.x[0] == 0);  // no tick
  CHECK(hold.advance(1ms, One::Zero()).motion.x[0] == 1);
}
