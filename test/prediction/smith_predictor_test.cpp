// SPDX-License-Identifier: MIT
#include <conformance/predictor_suite.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/prediction/smith_predictor.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

using limpid::KelvinVoigt;
using limpid::Known;
using limpid::SmithPredictor;
using limpid::Status;
using limpid::Time;
using limpid::Tool;
using namespace std::chrono_literals;

namespace {

using One = Eigen::Array<double, 1, 1>;
using Env = KelvinVoigt<1>;
using Predictor = SmithPredictor<Env, Tool<1>, Known>;

One one(double value) { return One::Constant(value); }
double press(double t) { return 1.5 * (1 - std::cos(2 * M_PI * t)); }

const Tool<1> tool{.mass = 0.1, .damping = 0.1, .stiffness = 1};

// Of 1000 steps, some 20 roundings in each, on sizes of 10 mm and 0.1 m/s.
constexpr double many_steps = 1000 * 20 * std::numeric_limits<double>::epsilon();

}  // namespace

TEST_CASE_TEMPLATE("the Smith predictor obeys the laws in a linear environment", Scalar, float, double) {
  using Three = KelvinVoigt<3, Scalar>;
  typename Three::Theta theta;
  theta.col(0).setConstant(800);
  theta.col(1).setConstant(30);
  limpid::test::check_predictor(SmithPredictor<Three>(
      {.environment = {}, .tool = {.mass = Scalar(0.1), .damping = Scalar(0.1)}, .theta = theta}));
}

TEST_CASE("the Smith predictor obeys the laws in a nonlinear environment") {
  using Layers = limpid::SmoothBilinear<1>;
  limpid::test::check_predictor(
      SmithPredictor<Layers, Tool<1>, Known>({.environment = Layers({.depth = 0.008, .sharpness = 20}),
                                              .tool = {.mass = 0.1, .damping = 0.1},
                                              .theta = Layers::Theta(200, 2000, 20)}));
}

TEST_CASE("with the true model and start the Smith predictor gives the truth, and samples change nothing") {
  const Env::Theta theta(800, 20);
  limpid::VirtualTool<Env> truth({.theta = theta, .tool = tool, .x0 = one(0.002), .v0 = one(0.05)});
  Predictor predictor({.tool = tool, .theta = theta, .start = {.x = one(0.002), .v = one(0.05)}});
  std::vector<limpid::ToolState<1>> past;
  for (int k = 0; k < 1000; ++k) {
    const One F = one(press(1e-3 * k));
    past.push_back(truth.advance(k * 1ms, F).value);
    if (k % 32 == 0 && k > 0)
      REQUIRE(predictor.observe({past[static_cast<std::size_t>(k - 32)], (k - 32) * 1ms, k * 1ms}) == Status::ok);
    const auto motion = predictor.advance(k * 1ms, F).motion;
    REQUIRE(std::abs(motion.x[0] - past.back().x[0]) < many_steps * 0.01);
    REQUIRE(std::abs(motion.v[0] - past.back().v[0]) < many_steps * 0.1);
    REQUIRE(std::abs(motion.a[0] - past.back().a[0]) < many_steps * (0.1 * 200 + 0.01 * 8000));
  }
}

// The model rests at its own zero force and the tool at d: both see no press, so that all of d comes from the sample.
TEST_CASE("what the sample differs from the model at its instant is added from its arrival on, and held") {
  Predictor predictor({.tool = {.mass = 0.1}, .theta = Env::Theta(800, 20)});
  (void)predictor.advance(0ms, one(0));
  (void)predictor.advance(10ms, one(0));
  REQUIRE(predictor.observe({{one(0.003), one(0.25), one(0), one(0)}, 5ms, 20ms}) == Status::ok);
  for (const Time now : {20ms, 21ms, 300ms}) {
    const auto [motion, status] = predictor.advance(now, one(0));
    CHECK(status == Status::ok);
    CHECK(motion.x[0] == 0.003);
    CHECK(motion.v[0] == 0.25);
    CHECK(motion.a[0] == 0);
  }
}

TEST_CASE(
    "the Smith predictor drops a sample from before its history, and compares one from before the start with it") {
  SmithPredictor<Env, Tool<1>, Known, 8> predictor(
      {.tool = {.mass = 0.1}, .theta = Env::Theta(800, 20), .start = {.x = one(0), .v = one(0)}});
  (void)predictor.advance(0ms, one(0));
  REQUIRE(predictor.observe({{one(0.001), one(0), one(0), one(0)}, -5ms, 1ms}) == Status::ok);
  for (int k = 1; k < 20; ++k) CHECK(predictor.advance(k * 1ms, one(0)).motion.x[0] == 0.001);
  REQUIRE(predictor.observe({{one(0.5), one(0), one(0), one(0)}, 2ms, 20ms}) == Status::ok);
  const auto [motion, status] = predictor.advance(20ms, one(0));
  CHECK(status == Status::out_of_history);
  CHECK(motion.x[0] == 0.001);
}
