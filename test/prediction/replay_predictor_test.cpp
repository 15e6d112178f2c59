// SPDX-License-Identifier: MIT
#include <conformance/predictor_suite.hpp>
#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/prediction/replay_predictor.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using limpid::Intersample;
using limpid::KelvinVoigt;
using limpid::Known;
using limpid::ReplayPredictor;
using limpid::Status;
using limpid::Time;
using limpid::Tool;
using namespace std::chrono_literals;

namespace {

using One = Eigen::Array<double, 1, 1>;
using Env = KelvinVoigt<1>;
using Predictor = ReplayPredictor<Env, Tool<1>, Known>;

One one(double value) { return One::Constant(value); }
double press(double t) { return 1.5 * (1 - std::cos(2 * M_PI * t)) + std::sin(47 * t); }

const Tool<1> tool{.mass = 0.1, .damping = 0.1, .stiffness = 1, .anchor = one(-0.01)};

/// Truth at ticks and at one instant between each two of them, for a force that obeys `intersample` between ticks.
template <typename E>
struct Run {
  limpid::VirtualTool<E> truth;
  Intersample intersample;
  std::vector<limpid::ToolSample<1>> samples{};  // of every instant; arrival is for the test to set
  Time last{};
  One F = one(0);

  limpid::ToolState<1> tick(Time now, const One& F_h) {
    if (now > last && last > 0ms) {
      const Time middle = last + (now - last) / 3;
      const double part = limpid::in_seconds(middle - last) / limpid::in_seconds(now - last);
      const One between = intersample == Intersample::linear ? One(F + (F_h - F) * part) : F;
      add(truth.advance(middle, between).value, middle);
    }
    last = now;
    F = F_h;
    const auto value = truth.advance(now, F_h).value;
    add(value, now);
    return value;
  }
  void add(const limpid::ToolState<1>& value, Time taken) { samples.push_back({value, taken, taken}); }
};

// Roundings of the 300 steps that truth and replay take at most, some 20 in each, on sizes of 10 mm and 0.3 m/s; what
// is taken between ticks has two steps for one.
constexpr double many_steps = 2 * 300 * 20 * std::numeric_limits<double>::epsilon();
constexpr double of_x = many_steps * 0.01, of_v = many_steps * 0.3;

}  // namespace

TEST_CASE_TEMPLATE("the replay predictor obeys the laws in a linear environment", Scalar, float, double) {
  using Three = KelvinVoigt<3, Scalar>;
  typename Three::Theta theta;
  theta.col(0).setConstant(800);
  theta.col(1).setConstant(30);
  for (const int ticks : {2, 64}) {
    limpid::test::check_predictor(ReplayPredictor<Three>({.environment = {},
                                                          .tool = {.mass = Scalar(0.1), .damping = Scalar(0.1)},
                                                          .theta = theta,
                                                          .ticks_per_update = ticks}));
  }
}

TEST_CASE("the replay predictor obeys the laws in a nonlinear environment") {
  using Contact = limpid::HuntCrossley<1>;
  limpid::test::check_predictor(ReplayPredictor<Contact, Tool<1>, Known>({.environment = Contact({.exponent = 1.5}),
                                                                          .tool = {.mass = 0.1, .damping = 0.1},
                                                                          .theta = Contact::Theta(3000, 10, 20)}));
}

TEST_CASE("with the true model it is exact from the first sample on, whatever ticks and samples are like") {
  for (const Intersample intersample : {Intersample::linear, Intersample::hold}) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      std::mt19937 random(seed);
      const auto pick = [&](int most) { return std::uniform_int_distribution<int>(0, most)(random); };
      const Env::Theta theta(800, 20);
      Run<Env> run{limpid::VirtualTool<Env>(
                       {.theta = theta, .tool = tool, .intersample = intersample, .x0 = one(0.002), .v0 = one(0.05)}),
                   intersample};
      Predictor predictor({.tool = tool, .theta = theta, .intersample = intersample});
      bool any = false;
      for (Time now = 1ms; now < 1500ms; now += seed == 1 ? Time(1ms) : 500us + pick(1000) * 1us) {
        const double t = limpid::in_seconds(now);
        const auto truth = run.tick(now, one(press(t)));
        // late by up to 60 instants, in any order, most of them lost
        if (pick(9) == 0 && run.samples.size() > 60) {
          auto sample = run.samples[run.samples.size() - 1 - static_cast<std::size_t>(pick(59))];
          sample.arrived = now;
          any |= predictor.observe(sample) == Status::ok;
        }
        const auto [motion, status] = predictor.advance(now, one(press(t)));
        if (!any) continue;
        REQUIRE(status == Status::ok);
        REQUIRE(std::abs(motion.x[0] - truth.x[0]) < of_x);
        REQUIRE(std::abs(motion.v[0] - truth.v[0]) < of_v);
        REQUIRE(std::abs(motion.a[0] - truth.a[0]) < of_v * 200 + of_x * 8000);  // beta, kappa
      }
      REQUIRE(any);
    }
  }
}

TEST_CASE("what a wrong model did is gone with the first sample after the true one is known") {
  const Env::Theta theta(800, 20);
  Run<Env> run{limpid::VirtualTool<Env>({.theta = theta, .tool = tool}), Intersample::linear};
  ReplayPredictor<Env> predictor({.tool = tool, .theta = Env::Theta(300, 5)});
  for (int k = 1; k < 200; ++k) {
    const auto truth = run.tick(k * 1ms, one(press(1e-3 * k)));
    if (k == 120) REQUIRE(predictor.use({theta, k * 1ms}) == Status::ok);
    if (k == 50 || k == 150) {
      auto sample = run.samples[run.samples.size() - 1 - 40];  // 20 ms old: each second one is of a tick
      sample.arrived = k * 1ms;
      REQUIRE(predictor.observe(sample) == Status::ok);
    }
    const auto motion = predictor.advance(k * 1ms, one(press(1e-3 * k))).motion;
    if (k > 60 && k < 150) CHECK(std::abs(motion.x[0] - truth.x[0]) > 1e3 * of_x);
    if (k >= 150) CHECK(std::abs(motion.x[0] - truth.x[0]) < of_x);
  }
}

// A sample 100 ticks old at 4 ticks an update, while time goes on by one: 4 n >= 100 + n - 1 at n = 33.
TEST_CASE("a long replay is spread over ticks, the prediction before it goes on, then it takes over") {
  const Env::Theta theta(800, 20);
  Run<Env> run{limpid::VirtualTool<Env>({.theta = theta, .tool = tool, .x0 = one(0.002)}), Intersample::linear};
  Predictor::Settings settings{.tool = tool, .theta = theta, .ticks_per_update = 4, .start = {.x = one(-0.004)}};
  Predictor predictor(settings), without(settings);
  for (int k = 1; k < 300; ++k) {
    const auto truth = run.tick(k * 1ms, one(press(1e-3 * k)));
    if (k == 201 || k == 210) {  // the second waits for the first to end
      auto sample = run.samples[run.samples.size() - 1 - 200];
      REQUIRE(sample.taken == (k - 100) * 1ms);
      sample.arrived = k * 1ms;
      REQUIRE(predictor.observe(sample) == Status::ok);
    }
    const auto motion = predictor.advance(k * 1ms, one(press(1e-3 * k))).motion;
    const auto other = without.advance(k * 1ms, one(press(1e-3 * k))).motion;
    if (k < 201 + 32) REQUIRE(limpid::test::same(motion, other));
    if (k >= 201 && k < 201 + 32) REQUIRE(predictor.replaying());
    if (k >= 201 + 32) REQUIRE(std::abs(motion.x[0] - truth.x[0]) < of_x);
  }
  CHECK_FALSE(predictor.replaying());
}

TEST_CASE("in a nonlinear environment the replay errs as its step does, of order 3") {
  using Layers = limpid::SmoothBilinear<1>;
  const Layers layers({.depth = 0.008, .sharpness = 20});
  const Layers::Theta theta(200, 2000, 20);
  std::vector<double> worst;
  for (const Time tick : {Time(2ms), Time(1ms)}) {
    limpid::VirtualTool<Layers> truth({.environment = layers, .theta = theta, .tool = tool});
    ReplayPredictor<Layers, Tool<1>, Known> predictor({.environment = layers, .tool = tool, .theta = theta});
    std::vector<limpid::ToolSample<1>> samples;
    double error = 0;
    for (Time now{}; now <= 1s; now += tick) {
      const double t = limpid::in_seconds(now);
      // straight pieces of 20 ms, whatever the tick, so that both see the same force
      const double from = std::floor(t / 0.02 + 1e-9) * 0.02, part = (t - from) / 0.02;
      const auto curve = [](double s) { return 3 * (1 - std::cos(2 * M_PI * s)); };
      const One F = one(curve(from) + (curve(from + 0.02) - curve(from)) * part);
      const auto value = truth.advance(now, F).value;
      samples.push_back({value, now, now + 100ms});
      if (now >= 100ms && now.count() % 100'000'000 == 0) {
        const auto back = static_cast<std::size_t>(100ms / tick);
        REQUIRE(predictor.observe(samples[samples.size() - 1 - back]) == Status::ok);
      }
      error = std::max(error, std::abs(predictor.advance(now, F).motion.x[0] - value.x[0]));
    }
    worst.push_back(error);
  }
  MESSAGE("worst error in m at 2, 1 ms: ", worst[0], " ", worst[1]);
  CHECK(worst[1] < worst[0] / 6);  // an eighth, but for terms of higher order
  CHECK(worst[1] < 1e-7);          // of 10 mm
}

TEST_CASE("a sample from before the first tick is replayed from that tick on") {
  const Env::Theta theta(800, 20);
  Run<Env> run{limpid::VirtualTool<Env>({.theta = theta, .tool = tool, .x0 = one(0.002)}), Intersample::linear};
  Predictor predictor({.tool = tool, .theta = theta});
  for (int k = 1; k < 100; ++k) {
    const auto truth = run.tick(k * 1ms, one(press(1e-3 * k)));
    if (k == 20) REQUIRE(predictor.observe({{one(0.002), one(0), one(0), one(0)}, -5ms, 20ms}) == Status::ok);
    const auto motion = predictor.advance(k * 1ms, one(press(1e-3 * k))).motion;
    if (k >= 20) CHECK(std::abs(motion.x[0] - truth.x[0]) < of_x);
  }
}

TEST_CASE("a sample from before the history is dropped, and said so") {
  ReplayPredictor<Env, Tool<1>, Known, 8> predictor({.tool = tool, .theta = Env::Theta(800, 20)}), other = predictor;
  for (auto* p : {&predictor, &other}) {
    for (int k = 0; k < 20; ++k) (void)p->advance(k * 1ms, one(1));
  }
  REQUIRE(predictor.observe({{one(0.5), one(0), one(0), one(0)}, 2ms, 20ms}) == Status::ok);
  const auto [motion, status] = predictor.advance(20ms, one(1));
  CHECK(status == Status::out_of_history);
  CHECK(limpid::test::same(motion, other.advance(20ms, one(1)).motion));
}

TEST_CASE("a replay that falls out of the history is given up") {
  ReplayPredictor<Env, Tool<1>, Known, 8> predictor(
      {.tool = tool, .theta = Env::Theta(800, 20), .ticks_per_update = 2});
  for (int k = 0; k < 20; ++k) (void)predictor.advance(k * 1ms, one(1));
  // of ticks 13 to 20 none is left to replay from 12.5 on
  REQUIRE(predictor.observe({{one(0.01), one(0), one(0), one(0)}, 12500us, 20ms}) == Status::ok);
  CHECK(has(predictor.advance(20ms, one(1)).status, Status::out_of_history));
  CHECK_FALSE(predictor.replaying());
}

TEST_CASE("known parameters leave nothing to use") {
  const auto usable = [](auto predictor) {
    return requires { predictor.use({}); };
  };
  CHECK(usable(ReplayPredictor<Env>({.tool = tool, .theta = Env::Theta(800, 20)})));
  CHECK_FALSE(usable(Predictor({.tool = tool, .theta = Env::Theta(800, 20)})));
}

TEST_CASE("an estimate that is not finite is not used") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), huge = std::numeric_limits<double>::max();
  ReplayPredictor<Env> predictor({.tool = tool, .theta = Env::Theta(800, 20)}), other = predictor;
  CHECK(predictor.use({Env::Theta(nan, 20), 0ms}) == Status::not_finite);
  CHECK(predictor.use({Env::Theta(huge, 20), 0ms}) == Status::not_finite);
  for (int k = 0; k < 20; ++k)
    CHECK(limpid::test::same(predictor.advance(k * 1ms, one(1)).motion, other.advance(k * 1ms, one(1)).motion));
}

TEST_CASE("the replay predictor's settings are checked") {
  const auto refused = [](auto change, const char* text) {
    Predictor::Settings settings{.tool = tool, .theta = Env::Theta(800, 20)};
    change(settings);
    CHECK_THROWS_WITH_AS(Predictor{settings}, text, std::invalid_argument);
  };
  refused([](auto& s) { s.tool.mass = 0; }, "Tool: mass: expected finite and > 0, got 0");
  refused([](auto& s) { s.theta(0, 0) = NAN; }, "ReplayPredictor: theta: expected finite, got nan 20");
  refused([](auto& s) { s.ticks_per_update = 1; }, "ReplayPredictor: ticks_per_update: expected >= 2, got 1");
  refused([](auto& s) { s.start.x[0] = NAN; }, "ReplayPredictor: start: expected finite, got a motion that is not");
}
