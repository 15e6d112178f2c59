// SPDX-License-Identifier: MIT
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/prediction/tissue_predictor.hpp>

#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

namespace {

using namespace limpid;
using namespace std::chrono_literals;
using Env = SmoothBilinear<1>;
using One = Eigen::Array<double, 1, 1>;

double press(Time now) { return 1.5 * (1 - std::cos(std::numbers::pi * in_seconds(now))); }

// Squared errors of (x, v) from 4 s to 8 s, of a predictor and of the newest sample held.
struct Errors {
  double predictor = 0, hold = 0;
};

Errors run(TissuePredictor<>& predictor, Duration period) {
  VirtualTool<Env> tool({.environment = Env({.depth = 0.0028, .sharpness = 20}),
                         .theta = {370, 1980, 30},
                         .tool = {.mass = 0.1, .damping = 0.1}});
  Errors errors;
  ToolSample<1> on_the_way{}, held{};
  bool sent = false;
  for (Time now{0}; now <= 8s; now += 1ms) {
    const auto state = tool.advance(now, One(press(now))).value;
    if (now % period == 0ns) {
      if (sent) {
        on_the_way.arrived = now;
        CHECK(predictor.observe(on_the_way) == Status::ok);
        held = on_the_way;
      }
      on_the_way = {state, now, now};
      sent = true;
    }
    const auto [motion, status] = predictor.advance(now, One(press(now)));
    if (now < 4s) continue;
    const auto square = [&](double x, double v) {
      return (x - state.x[0]) * (x - state.x[0]) + (v - state.v[0]) * (v - state.v[0]);
    };
    errors.predictor += square(motion.x[0], motion.v[0]);
    errors.hold += square(held.value.x[0], held.value.v[0]);
  }
  return errors;
}

}  // namespace

TEST_CASE("of a tissue of which nothing is known a hundredth of hold's error is left after two presses") {
  const auto predictor = make_tissue_predictor<double>({.mass = 0.1, .tool_damping = 0.1, .period = 32ms});
  const Errors errors = run(*predictor, 32ms);
  // five times what is asked of clean samples after four presses
  CHECK(errors.predictor < 0.01 * 0.01 * errors.hold);
}

TEST_CASE("a tissue's predictor asks for no memory in the loop") {
  const auto predictor = make_tissue_predictor<double>({.mass = 0.1, .tool_damping = 0.1, .period = 100ms});
  ToolSample<1> sample{};
  Time now{0};
  limpid::test::check_no_allocation([&] {
    for (; now <= 500ms; now += 1ms) {
      if (now > 0ms && now % 100ms == 0ns) {
        sample.taken = now - 100ms;
        sample.arrived = now;
        (void)predictor->observe(sample);
      }
      (void)predictor->advance(now, One(press(now)));
    }
  });
}

TEST_CASE("a tissue's predictor that cannot serve is refused by name") {
  CHECK_THROWS_WITH_AS((void)make_tissue_predictor<double>({.mass = 0}),
                       "TissueLearner: mass: expected finite and > 0, got 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)make_tissue_predictor<double>({.mass = 0.1, .period = 0ms}),
                       "TissuePredictor: period: expected > 0 s, got 0 s", std::invalid_argument);
}

TEST_CASE("after two seconds of samples that are wild the tissue is learnt anew") {
  const unsigned seed = 7;
  CAPTURE(seed);
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> wild(-1, 1);
  const auto predictor = make_tissue_predictor<double>({.mass = 0.1, .tool_damping = 0.1, .period = 32ms});
  VirtualTool<Env> tool({.environment = Env({.depth = 0.0028, .sharpness = 20}),
                         .theta = {370, 1980, 30},
                         .tool = {.mass = 0.1, .damping = 0.1}});
  double error = 0, error_of_hold = 0;
  ToolSample<1> on_the_way{}, held{};
  for (Time now{0}; now <= 14s; now += 1ms) {
    const auto state = tool.advance(now, One(press(now))).value;
    if (now % 32ms == 0ns) {
      on_the_way.arrived = now;
      if (now > 0ms) (void)predictor->observe(on_the_way);
      held = on_the_way;
      on_the_way = {state, now, now};
      if (now >= 4s && now < 6s) {
        on_the_way.value.x[0] = 9 * wild(generator);
        on_the_way.value.v[0] = 90 * wild(generator);
        on_the_way.value.force[0] = 9000 * wild(generator);
      }
    }
    const auto motion = predictor->advance(now, One(press(now))).motion;
    CHECK(std::abs(motion.x[0]) < 10);
    if (now < 12s) continue;
    error += std::pow(motion.v[0] - state.v[0], 2);
    error_of_hold += std::pow(held.value.v[0] - state.v[0], 2);
  }
  CHECK(error < 0.05 * 0.05 * error_of_hold);  // it is a fiftieth of that where nothing was wild
}
