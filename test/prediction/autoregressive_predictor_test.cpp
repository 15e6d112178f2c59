// SPDX-License-Identifier: MIT
#include <conformance/predictor_suite.hpp>
#include <limpid/prediction/autoregressive_predictor.hpp>
#include <limpid/prediction/stable_recursion.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

using limpid::AutoregressivePredictor;
using limpid::Status;
using limpid::Time;
using namespace std::chrono_literals;

namespace {

using One = Eigen::Array<double, 1, 1>;
One one(double value) { return One::Constant(value); }

/// c + A exp(-decay t) cos(omega t)
struct Oscillation {
  double c = 0.004, A = 0.003, decay = 0.2, omega = 15;

  [[nodiscard]] double x(double t) const { return c + A * std::exp(-decay * t) * std::cos(omega * t); }
  [[nodiscard]] double v(double t) const {
    return -A * std::exp(-decay * t) * (decay * std::cos(omega * t) + omega * std::sin(omega * t));
  }
  [[nodiscard]] limpid::ToolSample<1> sample(Time taken, Time arrived) const {
    const double t = limpid::in_seconds(taken);
    return {{one(x(t)), one(v(t)), one(0), one(0)}, taken, arrived};
  }
};

constexpr Time period = 20ms;
constexpr double T = 0.02;

}  // namespace

TEST_CASE("the autoregressive predictor obeys the laws") {
  limpid::test::check_predictor(AutoregressivePredictor<2>({.period = 7ms}));
  limpid::test::check_predictor(AutoregressivePredictor<1>({.period = 7ms}));
  limpid::test::check_predictor(AutoregressivePredictor<4, 3, float>({.period = 7ms, .least_move = 1e-5F}));
}

// (z - e^((-s + i w) T)) (z - e^((-s - i w) T)) = z^2 - a_1 z - a_2. What the start weighs, 1 against some 1e5 a
// sample, is forgotten as exp(-n/20): 1e-14 after 400 samples. Roundings of d, 1e-18 of 1e-4 m, are 1e-14, too; of a_2
// they are more by 1/sin^2(w T) = 12; some ten of each: 1e-11.
TEST_CASE("a damped oscillation about any depth is identified, and predicted exactly at whole periods") {
  const Oscillation truth;
  AutoregressivePredictor<2> predictor({.period = period});
  double worst = 0, worst_between = 0;
  for (Time now{}; now <= 10s; now += 1ms) {
    const Time delay = period;
    if (now >= delay && now.count() % period.count() == 0)
      REQUIRE(predictor.observe(truth.sample(now - delay, now)) == Status::ok);
    const auto motion = predictor.advance(now, one(0)).motion;
    if (now < 8s) continue;
    REQUIRE(predictor.predicts(0));
    const double t = limpid::in_seconds(now), error = std::abs(motion.x[0] - truth.x(t));
    if (now.count() % period.count() == 0) {
      worst = std::max(worst, error / truth.A);
      CHECK(std::abs(motion.v[0] - truth.v(t)) < 1e-10 * truth.A * truth.omega);
    }
    worst_between = std::max(worst_between, error / truth.A);
  }
  CHECK(predictor.coefficients()(0, 0) ==
        doctest::Approx(2 * std::exp(-truth.decay * T) * std::cos(truth.omega * T)).epsilon(1e-10));
  CHECK(predictor.coefficients()(0, 1) == doctest::Approx(-std::exp(-2 * truth.decay * T)).epsilon(1e-10));
  MESSAGE("worst errors over the amplitude, at whole periods and between: ", worst, " ", worst_between);
  CHECK(worst < 1e-10);
  CHECK(worst_between < std::pow(truth.omega * T, 4) / 384);  // of the cubic: x'''' T^4 / 384
}

TEST_CASE("a lost sample is read from its neighbours") {
  const Oscillation truth;
  AutoregressivePredictor<2> predictor({.period = period});
  for (int k = 0; k < 300; ++k) {
    const Time now = period * k;
    if (k % 20 != 7 && k > 0) REQUIRE(predictor.observe(truth.sample(now - period, now)) == Status::ok);
    const auto motion = predictor.advance(now, one(0)).motion;
    if (k < 100) continue;
    CHECK(predictor.predicts(0));
    // of the cubic over two periods, read three times and led on for two or three periods: some ten times that
    const double cubic = truth.A * std::pow(truth.omega * 2 * T, 4) / 384;
    CHECK(std::abs(motion.x[0] - truth.x(limpid::in_seconds(now))) < 10 * cubic);
  }
}

TEST_CASE("irregular samples are read at whole periods, for a tenth of hold's error") {
  const Oscillation truth;
  std::mt19937 random(1);
  std::uniform_int_distribution<int> jitter(-4000, 4000);  // us, of 20 ms
  AutoregressivePredictor<2> predictor({.period = period});
  double mine = 0, hold = 0;
  Time next = period;
  double held = 0;
  for (Time now = period; now <= 10s; now += 1ms) {
    if (now >= next + period) {
      const auto sample = truth.sample(next, now);
      REQUIRE(predictor.observe(sample) == Status::ok);
      held = sample.value.x[0];
      next += period + jitter(random) * 1us;
    }
    const double x = truth.x(limpid::in_seconds(now)), error = predictor.advance(now, one(0)).motion.x[0] - x;
    if (now < 4s) continue;
    mine += error * error;
    hold += (held - x) * (held - x);
  }
  MESSAGE("root mean square over hold's: ", std::sqrt(mine / hold));
  CHECK(mine < 0.01 * hold);
}

TEST_CASE("it holds the sample while the past is not known so far back, and at rest") {
  AutoregressivePredictor<2> predictor({.period = period});
  const Oscillation truth;
  for (int k = 0; k < 4; ++k) {  // d[2] asks for a fourth sample
    CHECK_FALSE(predictor.predicts(0));
    REQUIRE(predictor.observe(truth.sample(period * k, period * k)) == Status::ok);
    const auto motion = predictor.advance(period * k + 5ms, one(0)).motion;
    if (k < 3) CHECK(motion.x[0] == truth.x(T * k));
  }
  AutoregressivePredictor<2> resting({.period = period});
  for (int k = 0; k < 100; ++k) {
    REQUIRE(resting.observe({{one(0.004), one(0), one(2), one(0)}, period * k, period * k}) == Status::ok);
    const auto motion = resting.advance(period * k + 5ms, one(0)).motion;
    CHECK_FALSE(resting.predicts(0));
    CHECK(motion.x[0] == 0.004);
    CHECK(motion.a[0] == 2);
  }
}

// Of a random walk the best guess is where it stands, and hold meets both equations as well as can be: what a
// recursion does better in some 20 samples is chance.
TEST_CASE("where nothing beats hold it mostly holds, and errs little more") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> step(-0.005, 0.005);
  AutoregressivePredictor<2> predictor({.period = period});
  double x = 0, v = 0, mine = 0, hold = 0, predicted = 0;
  One last = one(0);
  for (int k = 1; k < 2000; ++k) {
    const double before = x;
    x += step(random);
    v += 50 * step(random);
    mine += (last[0] - x) * (last[0] - x);
    hold += (before - x) * (before - x);
    REQUIRE(predictor.observe({{one(x), one(v), one(2), one(0)}, period * k, period * k}) == Status::ok);
    (void)predictor.advance(period * k, one(0));
    last = predictor.advance(period * k + period - 1ns, one(0)).motion.x;
    predicted += predictor.predicts(0) ? 1 : 0;
  }
  MESSAGE("share of samples predicted, root mean square error over hold's: ", predicted / 2000, " ",
          std::sqrt(mine / hold));
  CHECK(predicted < 0.1 * 2000);
  CHECK(mine < 1.1 * hold);
}

TEST_CASE("what grows is led on only as far as it may, then the sample is held") {
  AutoregressivePredictor<1> predictor({.period = period, .growth = 1.5, .reach = 0.02});
  const auto x = [](int k) { return 1e-4 * std::pow(1.2, k); };
  const double rate = std::log(1.2) / T;
  double last = 0;
  for (int k = 0; k < 26; ++k) {  // to 9.5 mm
    last = x(k);
    REQUIRE(predictor.observe({{one(last), one(rate * last), one(0), one(0)}, period * k, period * k}) == Status::ok);
    (void)predictor.advance(period * k, one(0));
  }
  REQUIRE(predictor.predicts(0));
  CHECK(predictor.advance(period * 26, one(0)).motion.x[0] == doctest::Approx(x(26)).epsilon(1e-6));
  CHECK(predictor.advance(period * 29, one(0)).motion.x[0] == doctest::Approx(x(29)).epsilon(1e-6));
  CHECK(predictor.advance(period * 60, one(0)).motion.x[0] == last);  // 8 periods would be 41 mm
  CHECK_FALSE(predictor.predicts(0));
}

TEST_CASE("a recursion's roots are found inside a circle or not") {
  using Two = Eigen::Array<double, 2, 1>;
  using Three = Eigen::Array<double, 3, 1>;
  const auto from_roots = [](double p, double q, double r) {
    return Three(p + q + r, -(p * q + q * r + r * p), p * q * r);
  };
  for (const double largest : {0.2, 0.9, 0.999, 1.001, 1.5, 4.0}) {
    for (const double radius : {0.5, 1.0, 1.25}) {
      CAPTURE(largest);
      CAPTURE(radius);
      CHECK(limpid::roots_within<3, double>(from_roots(-largest, 0.1, 0.15), radius) == (largest < radius));
      CHECK(limpid::roots_within<3, double>(from_roots(largest, 0.1, -0.15), radius) == (largest < radius));
      for (const double angle : {0.3, 1.5, 3.0})
        CHECK(limpid::roots_within<2, double>(Two(2 * largest * std::cos(angle), -largest * largest), radius) ==
              (largest < radius));
    }
  }
}

TEST_CASE("the autoregressive predictor's settings are checked") {
  using P = AutoregressivePredictor<2>;
  CHECK_THROWS_WITH_AS(P({}), "AutoregressivePredictor: period: expected > 0 and at most an hour, got 0 s",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(P({.period = 1ms, .forgetting = -1}),
                       "AutoregressivePredictor: forgetting: expected finite and >= 0, got -1", std::invalid_argument);
  CHECK_THROWS_WITH_AS(P({.period = 1ms, .growth = 0}),
                       "AutoregressivePredictor: growth: expected finite and > 0, got 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(P({.period = 1ms, .reach = 0}), "AutoregressivePredictor: reach: expected finite and > 0, got 0",
                       std::invalid_argument);
}
