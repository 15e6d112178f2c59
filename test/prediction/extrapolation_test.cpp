// SPDX-License-Identifier: MIT
#include <conformance/predictor_suite.hpp>
#include <limpid/prediction/linear_predictor.hpp>
#include <limpid/prediction/quadratic_predictor.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

using limpid::LinearPredictor;
using limpid::QuadraticPredictor;
using limpid::Status;
using limpid::Time;
using namespace std::chrono_literals;

namespace {

using One = Eigen::Array<double, 1, 1>;
One one(double value) { return One::Constant(value); }

constexpr double rounding = std::numeric_limits<double>::epsilon();

// m_t x'' + b_t x' + k_t (x - anchor) = F_h - F_e
template <int Axes = 1, typename Scalar = double>
limpid::Tool<Axes, Scalar> tool() {
  return {.mass = Scalar(0.1), .damping = Scalar(0.5), .stiffness = Scalar(200)};
}

}  // namespace

TEST_CASE_TEMPLATE("the linear predictor obeys the laws", P, LinearPredictor<1>, LinearPredictor<3, float>) {
  limpid::test::check_predictor(P{});
}

TEST_CASE_TEMPLATE("the quadratic predictor obeys the laws", Scalar, float, double) {
  limpid::test::check_predictor(QuadraticPredictor<3, Scalar>({.tool = tool<3, Scalar>()}));
}

TEST_CASE("a uniform motion is predicted exactly by the linear predictor, and held beyond its horizon") {
  LinearPredictor<1> predictor({.start = {.x = one(0.5)}, .horizon = 20ms});
  CHECK(predictor.advance(0ms, one(0)).motion.x[0] == 0.5);
  REQUIRE(predictor.observe({{one(0.25), one(0.5), one(9), one(4)}, 1ms, 9ms}) == Status::ok);
  for (const int age : {8, 12, 20, 21, 900}) {
    const auto [motion, status] = predictor.advance((1 + age) * 1ms, one(3));
    CHECK(status == Status::ok);
    CHECK(motion.x[0] == doctest::Approx(0.25 + 0.5 * 1e-3 * std::min(age, 20)).epsilon(4 * rounding));
    CHECK(motion.v[0] == 0.5);
    CHECK(motion.a[0] == 0);
  }
}

// The operator presses so that the net force is 0.3 N: x'' = 3 m/s^2, whatever the tool and the tissue.
TEST_CASE("a parabola is predicted exactly by the quadratic predictor from a sample of any age") {
  const double a = 3, x0 = 0.001, v0 = -0.02, F_e = 0.7;
  const auto x = [&](double t) { return x0 + v0 * t + a / 2 * t * t; };
  const auto v = [&](double t) { return v0 + a * t; };
  const auto settings = tool();
  const auto F_h = [&](double t) {
    return settings.mass * a + F_e + settings.damping * v(t) + settings.stiffness * x(t);
  };
  for (const Time delay : {Time(0ms), Time(7ms), Time(100ms)}) {
    QuadraticPredictor<1> predictor({.tool = settings});
    for (Time now{}; now <= 300ms; now += 1ms) {
      const double t = limpid::in_seconds(now), taken = limpid::in_seconds(now - delay);
      if (now.count() % 16'000'000 == 0 && now >= delay) {
        REQUIRE(predictor.observe({{one(x(taken)), one(v(taken)), one(0), one(F_e)}, now - delay, now}) == Status::ok);
      }
      const auto [motion, status] = predictor.advance(now, one(F_h(t)));
      if (status == Status::no_sample) continue;
      REQUIRE(status == Status::ok);
      // some 20 roundings of forces up to 30 N, over 0.1 kg: of a; of x and v by t^2/2 and t, t <= 0.12 s
      const double of_a = 20 * rounding * 30 / 0.1;
      CHECK(std::abs(motion.a[0] - a) < of_a);
      CHECK(std::abs(motion.v[0] - v(t)) < of_a);
      CHECK(std::abs(motion.x[0] - x(t)) < of_a);
    }
  }
}

TEST_CASE("the quadratic predictor holds the motion of its horizon") {
  QuadraticPredictor<1> predictor({.tool = {.mass = 0.5}, .horizon = 20ms});
  (void)predictor.advance(0ms, one(1));
  REQUIRE(predictor.observe({{one(0), one(0), one(0), one(0)}, 0ms, 1ms}) == Status::ok);
  for (const int age : {10, 20, 100}) {
    const double t = 1e-3 * std::min(age, 20);
    const auto motion = predictor.advance(age * 1ms, one(0)).motion;
    CHECK(motion.x[0] == doctest::Approx(t * t).epsilon(4 * rounding));  // a = 2
    CHECK(motion.v[0] == doctest::Approx(2 * t).epsilon(4 * rounding));
  }
}

TEST_CASE("a force that is no longer remembered is said so, and the nearest one used") {
  QuadraticPredictor<1, double, 8> predictor({.tool = {.mass = 1}});
  for (int k = 0; k < 20; ++k) (void)predictor.advance(k * 1ms, one(k));
  REQUIRE(predictor.observe({{one(0), one(0), one(0), one(0)}, 2ms, 20ms}) == Status::ok);
  const auto [motion, status] = predictor.advance(20ms, one(20));
  CHECK(status == Status::out_of_history);
  CHECK(motion.a[0] == 13);  // of ticks 13 to 20
}

TEST_CASE("an extrapolation's settings are checked") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(LinearPredictor<1>({.start = {.x = one(nan)}}),
                       "LinearPredictor: start: expected finite, got a motion that is not", std::invalid_argument);
  CHECK_THROWS_WITH_AS(LinearPredictor<1>({.horizon = -1ns}), "LinearPredictor: horizon: expected >= 0, got -1e-09 s",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(QuadraticPredictor<1>({}), "Tool: mass: expected finite and > 0, got 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(QuadraticPredictor<1>({.tool = {.mass = 1}, .horizon = -1ns}),
                       "QuadraticPredictor: horizon: expected >= 0, got -1e-09 s", std::invalid_argument);
}
