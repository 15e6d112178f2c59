// SPDX-License-Identifier: MIT
#include <conformance/predictor_suite.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/prediction/curve_predictor.hpp>
#include <limpid/prediction/hold_predictor.hpp>
#include <limpid/signal/delayed_sampled.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace {

using namespace limpid;
using namespace std::chrono_literals;
using One = Eigen::Array<double, 1, 1>;

CurvePredictor<>::Settings settings() { return {.learner = {.mass = 0.1, .tool_damping = 0.1}}; }

double square(double value) { return value * value; }

struct Errors {
  double early = 0, late = 0;  // of (x, v) in L2 over hold's: the first four seconds, after eight
};

// Twelve seconds of presses; samples each `period`, as late.
template <typename Env>
Errors errors(const Env& env, const EnvironmentTheta<Env>& theta, Duration period) {
  VirtualTool<Env> tool({.environment = env, .theta = theta, .tool = {.mass = 0.1, .damping = 0.1}});
  DelayedSampled<ToolState<1>, 512> sampled({.period = period, .delay = period});
  const auto predictor = std::make_unique<CurvePredictor<>>(settings());
  HoldPredictor<1> hold;
  double mine[2] = {}, held[2] = {};
  for (Time now{0}; now < 12s; now += 1ms) {
    const One F(1.5 * (1 - std::cos(std::numbers::pi * in_seconds(now))));
    const auto truth = tool.advance(now, F).value;
    const auto seen = sampled.update(now, truth);
    if (seen.fresh) {
      (void)predictor->observe({seen.value, seen.taken, seen.arrived});
      (void)hold.observe({seen.value, seen.taken, seen.arrived});
    }
    const auto p = predictor->advance(now, F).motion, h = hold.advance(now, F).motion;
    if (now >= 4s && now < 8s) continue;
    const std::size_t part = now < 4s ? 0 : 1;
    mine[part] += square(p.x[0] - truth.x[0]) + square(p.v[0] - truth.v[0]);
    held[part] += square(h.x[0] - truth.x[0]) + square(h.v[0] - truth.v[0]);
  }
  return {std::sqrt(mine[0] / held[0]), std::sqrt(mine[1] / held[1])};
}

}  // namespace

static_assert(Predictor<CurvePredictor<>>);

TEST_CASE("the curve predictor obeys the laws of predictors") {
  limpid::test::check_predictor(CurvePredictor<>(settings()));
}

// The bounds are those that limpid sets itself for clean samples after eight seconds: 0.002 of hold's error.
TEST_CASE("a linear tissue is predicted after eight seconds with a five-hundredth of hold's error") {
  for (const Duration period : {16ms, 100ms}) {
    const Errors found = errors(KelvinVoigt<1>{}, {800, 30}, period);
    CHECK(found.early < 0.1);
    CHECK(found.late < 0.002);
  }
}

TEST_CASE("a tissue that stiffens is predicted after eight seconds with a five-hundredth of hold's error") {
  const SmoothBilinear<1> tissue({.depth = 0.005, .sharpness = 20});
  CHECK(errors(tissue, {450, 1000, 30}, 16ms).late < 0.002);
  CHECK(errors(tissue, {450, 1000, 30}, 32ms).late < 0.002);
}

TEST_CASE("samples that come late, twice and in the wrong order do no harm") {
  const auto predictor = std::make_unique<CurvePredictor<>>(settings());
  ToolState<1> state;
  state.x[0] = 0.001;
  (void)predictor->advance(0ms, One(0.0));
  (void)predictor->advance(1ms, One(0.1));
  CHECK(predictor->observe({state, 1ms, 1ms}) == Status::ok);
  CHECK(predictor->advance(2ms, One(0.2)).status == Status::ok);
  CHECK(predictor->observe({state, 1ms, 2ms}) == Status::out_of_order);
  CHECK(predictor->observe({state, 0ms, 2ms}) == Status::out_of_order);
  CHECK(predictor->observe({state, 5ms, 4ms}) == Status::clock_backwards);
}

TEST_CASE("a curve predictor's start that is not finite or out of all reach is refused") {
  auto bad = settings();
  bad.start.x[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(CurvePredictor<>{bad}, "CurvePredictor: start: expected finite, got a motion that is not",
                       std::invalid_argument);
  bad.start.x[0] = 11;
  CHECK_THROWS_WITH_AS(CurvePredictor<>{bad}, "CurvePredictor: start: expected within 10 m and 100 m/s, got 11",
                       std::invalid_argument);
}

TEST_CASE("as long as a free tool has felt nothing the newest sample is held, its acceleration too") {
  auto wary = settings();
  wary.learner.contact = true;
  const auto predictor = std::make_unique<CurvePredictor<>>(wary);
  for (Time now{0}; now <= 100ms; now += 1ms) {
    ToolState<1> free;  // 1 N on 0.1 kg
    free.x[0] = 5 * in_seconds(now) * in_seconds(now);
    free.v[0] = 10 * in_seconds(now);
    if (now % 32ms == 0ns) (void)predictor->observe({free, now, now});
    const auto [motion, status] = predictor->advance(now, One(1.0));
    if (now < 64ms) continue;
    const double taken = in_seconds(now - now % 32ms);
    CHECK(status == Status::ok);
    CHECK(motion.x[0] == doctest::Approx(5 * taken * taken));
    CHECK(motion.v[0] == doctest::Approx(10 * taken));
    CHECK(motion.a[0] == 0);
  }
}
