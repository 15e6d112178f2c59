// SPDX-License-Identifier: MIT
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/tangent_model.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/prediction/model_predictor.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>

using limpid::Estimated;
using limpid::Intersample;
using limpid::KelvinVoigt;
using limpid::Known;
using limpid::ModelPredictor;
using limpid::Status;
using limpid::Time;
using limpid::Tool;
using namespace std::chrono_literals;

namespace {

using One = Eigen::Array<double, 1, 1>;
using Env = KelvinVoigt<1>;
using Predictor = ModelPredictor<Env, Tool<1>, Known>;

One one(double value) { return One::Constant(value); }

/// m x'' + b x' + k x = f0 + slope t from (x0, v0), underdamped, in closed form.
struct Oscillator {
  double m, b, k, f0, slope, x0, v0;

  [[nodiscard]] limpid::Motion<1> at(double t) const {
    const double particular = f0 / k - b * slope / (k * k), rate = slope / k;  // + rate t
    const double decay = b / (2 * m), omega = std::sqrt(k / m - decay * decay);
    const double c = x0 - particular, s = (v0 - rate + decay * c) / omega;
    const double e = std::exp(-decay * t), cosine = std::cos(omega * t), sine = std::sin(omega * t);
    const double x = particular + rate * t + e * (c * cosine + s * sine);
    const double v = rate + e * (-decay * (c * cosine + s * sine) + omega * (s * cosine - c * sine));
    return {one(x), one(v), one((f0 + slope * t - b * v - k * x) / m)};
  }
};

// b + b_t = 2, k + k_t = 1000, m = 0.1
Predictor::Settings light() {
  return {.environment = {},
          .tool = {.mass = 0.1, .damping = 0.5, .stiffness = 200},
          .theta = Env::Theta(800, 1.5),
          .start = {.x = one(0.002), .v = one(0.01)}};
}

limpid::ToolSample<1> sample(double x, double v, Time taken, Time arrived) {
  return {{one(x), one(v), one(0), one(0)}, taken, arrived};
}

void check_close(const limpid::Motion<1>& a, const limpid::Motion<1>& b, double of_size) {
  CHECK(std::abs(a.x[0] - b.x[0]) < of_size);
  CHECK(std::abs(a.v[0] - b.v[0]) < of_size * 100);  // omega = 99.5 1/s
  CHECK(std::abs(a.a[0] - b.a[0]) < of_size * 10'000);
}

}  // namespace

// Roundings of 500 steps, each of some 20 on sizes up to 5 mm.
constexpr double many_steps = 500 * 20 * 5e-3 * std::numeric_limits<double>::epsilon();

TEST_CASE("for a force linear between ticks the step is exact, whatever the ticks") {
  const Oscillator exact{.m = 0.1, .b = 2, .k = 1000, .f0 = 1, .slope = 4, .x0 = 0.002, .v0 = 0.01};
  for (const Time tick : {Time(1ms), Time(250us), Time(7ms), Time(100ms)}) {
    Predictor predictor(light());
    for (Time now{}; now <= 500ms; now += tick) {
      const double t = limpid::in_seconds(now);
      check_close(predictor.advance(now, one(1 + 4 * t)).motion, exact.at(t), many_steps);
    }
  }
}

TEST_CASE("for a held force the step is exact where hold is stated") {
  auto settings = light();
  settings.intersample = Intersample::hold;
  Predictor predictor(settings);
  (void)predictor.advance(0ms, one(3));
  const auto first = predictor.advance(40ms, one(-1)).motion;
  Oscillator exact{.m = 0.1, .b = 2, .k = 1000, .f0 = 3, .slope = 0, .x0 = 0.002, .v0 = 0.01};
  CHECK(first.x[0] == doctest::Approx(exact.at(0.04).x[0]).epsilon(1e-13));
  CHECK(first.a[0] == doctest::Approx(exact.at(0.04).a[0] - 40).epsilon(1e-13));  // (F_h - 3) / m at once
  exact = {.m = 0.1, .b = 2, .k = 1000, .f0 = -1, .slope = 0, .x0 = first.x[0], .v0 = first.v[0]};
  const auto second = predictor.advance(90ms, one(5)).motion;
  CHECK(second.x[0] == doctest::Approx(exact.at(0.05).x[0]).epsilon(1e-13));
}

TEST_CASE("the tool's spring pulls to its anchor, the offset of the environment pushes from it") {
  ModelPredictor<limpid::Tangent<1>, Tool<1>, Known> predictor(
      {.environment = {},
       .tool = {.mass = 0.1, .damping = 1, .stiffness = 200, .anchor = one(-0.01)},
       .theta = limpid::Tangent<1>::Theta(800, 20, -0.5)});
  limpid::Prediction<1> last;
  for (int k = 0; k < 2000; ++k) last = predictor.advance(k * 1ms, one(4));
  CHECK(last.motion.x[0] == doctest::Approx((4 + 0.5 - 2) / 1000).epsilon(1e-12));  // at rest
  CHECK(std::abs(last.motion.a[0]) < 1e-9);
}

// e = x_hat(taken) - x_sample is held as a constant force L e from the tick of arrival on: (4.25) over two intervals.
TEST_CASE("the error at the sample's own instant acts from its arrival, and is held") {
  auto settings = light();
  settings.gain = {-100.0, -2.0};
  Predictor predictor(settings);
  (void)predictor.advance(0ms, one(1));
  const auto mine = predictor.advance(10ms, one(1)).motion;
  (void)predictor.advance(20ms, one(1));
  CHECK(predictor.observe(sample(0.001, 0.03, 10ms, 30ms)) == Status::ok);
  const auto arrival = predictor.advance(30ms, one(1)).motion;
  const Oscillator before{.m = 0.1, .b = 2, .k = 1000, .f0 = 1, .slope = 0, .x0 = 0.002, .v0 = 0.01};
  CHECK(arrival.x[0] == doctest::Approx(before.at(0.03).x[0]).epsilon(1e-12));

  const double feedback = -100 * (mine.x[0] - 0.001) - 2 * (mine.v[0] - 0.03);
  CHECK(arrival.a[0] == doctest::Approx(before.at(0.03).a[0] + feedback / 0.1).epsilon(1e-12));
  const Oscillator after{
      .m = 0.1, .b = 2, .k = 1000, .f0 = 1 + feedback, .slope = 0, .x0 = arrival.x[0], .v0 = arrival.v[0]};
  for (const Time now : {31ms, 40ms, 75ms}) {
    const auto got = predictor.advance(now, one(1)).motion;
    CHECK(got.x[0] == doctest::Approx(after.at(limpid::in_seconds(now) - 0.03).x[0]).epsilon(1e-12));
  }
}

TEST_CASE("a sample taken at the very tick is compared with that tick's own motion") {
  auto settings = light();
  settings.gain = {-100.0, 0.0};
  settings.start = {};
  Predictor predictor(settings);
  CHECK(predictor.observe(sample(-0.01, 0, 0ms, 0ms)) == Status::ok);
  const auto [motion, status] = predictor.advance(0ms, one(0));
  CHECK(status == Status::ok);
  CHECK(motion.a[0] == doctest::Approx(-100 * 0.01 / 0.1).epsilon(1e-15));
}

TEST_CASE("of two samples in one tick the newer holds, and late or repeated ones are dropped") {
  auto settings = light();
  settings.gain = {-100.0, 0.0};
  Predictor predictor(settings), other(settings);
  for (auto* p : {&predictor, &other}) {
    for (int k = 0; k < 10; ++k) (void)p->advance(k * 1ms, one(1));
  }
  CHECK(predictor.observe(sample(0.5, 0, 3ms, 10ms)) == Status::ok);
  CHECK(predictor.observe(sample(0.001, 0, 5ms, 10ms)) == Status::ok);
  CHECK(predictor.observe(sample(0.7, 0, 4ms, 10ms)) == Status::out_of_order);
  CHECK(predictor.observe(sample(0.7, 0, 5ms, 10ms)) == Status::out_of_order);
  CHECK(other.observe(sample(0.001, 0, 5ms, 10ms)) == Status::ok);
  for (int k = 10; k < 20; ++k)
    CHECK((predictor.advance(k * 1ms, one(1)).motion.x == other.advance(k * 1ms, one(1)).motion.x).all());
}

TEST_CASE("a sample from before the first tick is compared with the start") {
  auto settings = light();
  settings.gain = {-100.0, 0.0};
  Predictor predictor(settings);
  REQUIRE(predictor.observe(sample(-0.01, 0, -16ms, 0ms)) == Status::ok);
  const Oscillator exact{.m = 0.1, .b = 2, .k = 1000, .f0 = -100 * (0.002 + 0.01), .slope = 0, .x0 = 0.002, .v0 = 0.01};
  for (Time now{}; now <= 100ms; now += 1ms) {
    check_close(predictor.advance(now, one(0)).motion, exact.at(limpid::in_seconds(now)), many_steps);
  }
}

TEST_CASE("a sample from before the history or from the future is dropped, and said so") {
  using Short = ModelPredictor<Env, Tool<1>, Known, limpid::ConstantGain<1>, 8>;
  const Short::Settings settings{
      .environment = {}, .tool = light().tool, .theta = light().theta, .gain = {-100.0, 0.0}};
  Short predictor(settings), undisturbed(settings);
  for (auto* p : {&predictor, &undisturbed}) {
    for (int k = 0; k < 20; ++k) (void)p->advance(k * 1ms, one(1));
  }
  CHECK(predictor.observe(sample(0.5, 0, 2ms, 20ms)) == Status::ok);
  CHECK(predictor.advance(20ms, one(1)).status == Status::out_of_history);
  CHECK(predictor.observe(sample(0.5, 0, 90ms, 21ms)) == Status::clock_backwards);
  CHECK(predictor.observe(sample(0.5, 0, 90ms, 90ms)) == Status::ok);
  const auto [motion, status] = predictor.advance(21ms, one(1));
  CHECK(status == Status::out_of_history);
  (void)undisturbed.advance(20ms, one(1));
  CHECK((motion.x == undisturbed.advance(21ms, one(1)).motion.x).all());
}

TEST_CASE("an estimate holds from the next tick on, and one that is not finite never") {
  ModelPredictor<Env> predictor({.environment = {},
                                 .tool = {.mass = 0.1, .damping = 0.5, .stiffness = 200},
                                 .theta = Env::Theta(800, 1.5),
                                 .start = {.x = one(0.002), .v = one(0.01)}});
  (void)predictor.advance(0ms, one(1));
  CHECK(predictor.use({Env::Theta(1800, 1.5), 0ms}) == Status::ok);
  CHECK(predictor.use({Env::Theta(std::numeric_limits<double>::quiet_NaN(), 1.5), 0ms}) == Status::not_finite);
  const auto first = predictor.advance(10ms, one(1)).motion;
  const Oscillator soft{.m = 0.1, .b = 2, .k = 1000, .f0 = 1, .slope = 0, .x0 = 0.002, .v0 = 0.01};
  CHECK(first.x[0] == doctest::Approx(soft.at(0.01).x[0]).epsilon(1e-13));
  CHECK(first.a[0] == doctest::Approx((1 - 2 * first.v[0] - 2000 * first.x[0]) / 0.1).epsilon(1e-13));
  const Oscillator hard{.m = 0.1, .b = 2, .k = 2000, .f0 = 1, .slope = 0, .x0 = first.x[0], .v0 = first.v[0]};
  CHECK(predictor.advance(20ms, one(1)).motion.x[0] == doctest::Approx(hard.at(0.01).x[0]).epsilon(1e-13));
}

TEST_CASE("a scheduled gain follows the estimate's tangent") {
  using Scheduled = ModelPredictor<Env, Tool<1>, Estimated, limpid::ScheduledGain<1>>;
  Scheduled predictor(
      {.environment = {},
       .tool = {.mass = 0.1, .damping = 0.5},
       .theta = Env::Theta(800, 32),
       .gain = limpid::ScheduledGain<1>(
           {.L0 = {-100.0, 0.0}, .L1 = {0.25, 0.0}, .lower = {one(200), one(20)}, .upper = {one(2000), one(40)}})});
  CHECK(predictor.observe(sample(-0.01, 0, 0ms, 0ms)) == Status::ok);
  CHECK(predictor.advance(0ms, one(0)).motion.a[0] == doctest::Approx((-100 + 0.25 * 800) * 0.01 / 0.1).epsilon(1e-14));
  CHECK(predictor.use({Env::Theta(5000, 32), 0ms}) == Status::ok);
  CHECK(has(predictor.advance(1ms, one(0)).status, Status::at_bound));
}

TEST_CASE("the start, the parameters, the tool and the gain are checked") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](auto change, const char* text) {
    auto settings = light();
    change(settings);
    CHECK_THROWS_WITH_AS(Predictor{settings}, text, std::invalid_argument);
  };
  refused([](auto& s) { s.tool.mass = 0; }, "Tool: mass: expected finite and > 0, got 0");
  refused([&](auto& s) { s.theta(1) = nan; }, "ModelPredictor: theta: expected finite, got 800 nan");
  refused([](auto& s) { s.theta = Predictor::Settings{}.theta; },
          "ModelPredictor: theta: expected finite, got nan nan");
  refused([](auto& s) { s.theta(0) = 1e308; },
          "ModelPredictor: theta: expected a finite stiffness and damping over the tool's mass, got 1e+308 1.5");
  refused([](auto& s) { s.theta(1) = -1e308; },
          "ModelPredictor: theta: expected a finite stiffness and damping over the tool's mass, got 800 -1e+308");
  refused([](auto& s) { s.start.x[0] = 1e200; },
          "ModelPredictor: start: expected finite squares, got a motion that is too large");
  refused([&](auto& s) { s.start.v[0] = nan; }, "ModelPredictor: start: expected finite, got a motion that is not");
  refused([&](auto& s) { s.gain = {nan, 0.0}; }, "ConstantGain: L1: expected finite, got nan");
}

TEST_CASE("an estimate too stiff for the scalar is refused, and the one before stays") {
  const ModelPredictor<Env>::Settings settings{
      .environment = {}, .tool = {.mass = 0.1, .damping = 0.1}, .theta = Env::Theta(800, 30)};
  ModelPredictor<Env> predictor(settings), undisturbed(settings);
  for (auto* p : {&predictor, &undisturbed}) (void)p->advance(0ms, one(1));
  CHECK(predictor.use({Env::Theta(1e308, 30), 0ms}) == Status::not_finite);
  CHECK(predictor.use({Env::Theta(800, 1e308), 0ms}) == Status::not_finite);
  for (int k = 1; k < 20; ++k) {
    const auto [motion, status] = predictor.advance(k * 1ms, one(1));
    CHECK(status == Status::no_sample);
    CHECK((motion.x == undisturbed.advance(k * 1ms, one(1)).motion.x).all());
  }
}

TEST_CASE("the ideal tool refuses parameters too stiff for the scalar") {
  CHECK_THROWS_WITH_AS(
      limpid::VirtualTool<Env>({.theta = Env::Theta(1e308, 30), .tool = {.mass = 0.1}}),
      "VirtualTool: theta: expected a finite stiffness and damping over the tool's mass, got 1e+308 30",
      std::invalid_argument);
}

TEST_CASE("a sample too large for the force that it would make is dropped without a trace") {
  auto settings = light();
  settings.gain = {-100.0, 0.0};
  Predictor predictor(settings), undisturbed(settings);
  for (int k = 0; k < 100; ++k) {
    CAPTURE(k);
    if (k == 22) CHECK(predictor.observe(sample(1e306, 0, 19ms, 22ms)) == Status::ok);
    if (k % 7 == 6) {
      for (auto* p : {&predictor, &undisturbed})
        CHECK(p->observe(sample(0.001, 0, (k - 3) * 1ms, k * 1ms)) == Status::ok);
    }
    const auto mine = predictor.advance(k * 1ms, one(1)), other = undisturbed.advance(k * 1ms, one(1));
    CHECK(mine.status == (other.status | limpid::when(k == 22, Status::not_finite)));
    CHECK((mine.motion.x == other.motion.x).all());
    CHECK((mine.motion.a == other.motion.a).all());
  }
}

// L e / m = 1e307 is a number, but where it leads to is none that can be compared with another.
TEST_CASE("a step into the absurd is not taken: the tool stands, and goes on from there") {
  auto settings = light();
  settings.lost_beyond = std::numeric_limits<double>::infinity();  // else the sample has no say at all
  settings.gain = {-100.0, 0.0};
  Predictor predictor(settings);
  for (int k = 0; k < 20; ++k) (void)predictor.advance(k * 1ms, one(1));
  REQUIRE(predictor.observe(sample(1e304, 0, 19ms, 20ms)) == Status::ok);
  const auto last = predictor.advance(20ms, one(1));
  CHECK(last.status == Status::ok);

  SUBCASE("open until a sample comes") {
    const auto standing = predictor.advance(21ms, one(1));
    CHECK(standing.status == Status::not_finite);
    CHECK((standing.motion.x == last.motion.x).all());
    const Oscillator on{
        .m = 0.1, .b = 2, .k = 1000, .f0 = 1, .slope = 0, .x0 = last.motion.x[0], .v0 = last.motion.v[0]};
    for (int k = 22; k < 60; ++k) {
      const auto [motion, status] = predictor.advance(k * 1ms, one(1));
      CHECK(status == Status::ok);
      CHECK(motion.x[0] == doctest::Approx(on.at((k - 21) * 1e-3).x[0]).epsilon(1e-12));
    }
  }
  SUBCASE("with the sample that came in that very tick") {
    REQUIRE(predictor.observe(sample(0.001, 0, 21ms, 21ms)) == Status::ok);
    CHECK(predictor.advance(21ms, one(1)).status == Status::not_finite);
    const double feedback = -100 * (last.motion.x[0] - 0.001);  // compared with where it stands
    const Oscillator on{
        .m = 0.1, .b = 2, .k = 1000, .f0 = 1 + feedback, .slope = 0, .x0 = last.motion.x[0], .v0 = last.motion.v[0]};
    CHECK(predictor.advance(30ms, one(1)).motion.x[0] == doctest::Approx(on.at(0.009).x[0]).epsilon(1e-12));
  }
}

TEST_CASE("samples stamped in the future, however many in a tick, do not shut out later ones") {
  Predictor predictor(light());
  for (int k = 0; k < 10; ++k) (void)predictor.advance(k * 1ms, one(1));
  CHECK(predictor.observe(sample(0.001, 0, 90ms, 90ms)) == Status::ok);
  CHECK(predictor.observe(sample(0.001, 0, 95ms, 95ms)) == Status::ok);
  CHECK(predictor.advance(10ms, one(1)).status == (Status::out_of_history | Status::no_sample));
  CHECK(predictor.observe(sample(0.001, 0, 9ms, 11ms)) == Status::ok);
  CHECK(predictor.advance(11ms, one(1)).status == Status::ok);
}
