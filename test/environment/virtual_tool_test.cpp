// SPDX-License-Identifier: MIT
#include <limpid/environment/coupled.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/tangent_model.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <support/maximum.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using limpid::Coupled;
using limpid::Intersample;
using limpid::KelvinVoigt;
using limpid::Status;
using limpid::Tangent;
using limpid::Time;
using limpid::Tool;
using limpid::VirtualTool;
using limpid::test::maximum;
using namespace std::chrono_literals;

namespace {

template <typename Scalar>
using One = Eigen::Array<Scalar, 1, 1>;

}  // namespace

TEST_CASE_TEMPLATE("a step of force on an underdamped contact is answered in closed form", Scalar, float, double,
                   long double) {
  const Scalar m = Scalar(0.125), k = 2000, b = 25, F = 3;  // section 6.1.2, m rounded to binary
  VirtualTool<KelvinVoigt<1, Scalar>> tool({.theta = {{k, b}}, .tool = {.mass = m}});
  const Scalar decay = b / (2 * m), omega = std::sqrt(k / m - decay * decay);
  (void)tool.advance(0ms, One<Scalar>(F));
  for (int tick = 1; tick <= 300; ++tick) {
    CAPTURE(tick);
    const auto [state, status] = tool.advance(tick * 1ms, One<Scalar>(F));
    REQUIRE(status == Status::ok);
    const Scalar t = Scalar(tick) / 1000, fade = std::exp(-decay * t);
    const Scalar x = F / k * (1 - fade * (std::cos(omega * t) + decay / omega * std::sin(omega * t)));
    const Scalar v = F / (m * omega) * fade * std::sin(omega * t);
    const Scalar a = (F - k * x - b * v) / m;
    // some ten roundings a tick of x up to 2.2 mm, remembered for 1/decay = 10 ticks, and as much in the closed form,
    // whose angle reaches 24 rad; v = 0.25 m/s and a = 24 m/s^2 alike
    const Scalar roundings = 200 * std::numeric_limits<Scalar>::epsilon();
    REQUIRE(std::abs(state.x[0] - x) <= roundings * Scalar(0.0022));
    REQUIRE(std::abs(state.v[0] - v) <= roundings * Scalar(0.25));
    REQUIRE(std::abs(state.a[0] - a) <= roundings * 24);
    REQUIRE(std::abs(state.force[0] - (k * x + b * v)) <= roundings * 6);
  }
}

TEST_CASE("under a ramp of force a tool that starts on the steady solution stays on it, at irregular ticks") {
  // x = (F - b v)/k with v = F'/k: exact for a force that is linear between ticks
  const double k = 800, b = 30, ramp = 2;
  VirtualTool<KelvinVoigt<1>> tool({.theta = {{k, b}},
                                    .tool = {.mass = 0.1, .damping = 0.1},
                                    .x0 = One<double>(-(b + 0.1) * ramp / (k * k)),
                                    .v0 = One<double>(ramp / k)});
  std::mt19937 random(16421225);
  std::uniform_int_distribution<int> step(1, 20'000'000);
  Time now = 1h;
  const Time start = now;
  (void)tool.advance(now, One<double>(0));
  for (int tick = 0; tick < 200; ++tick) {
    CAPTURE(tick);
    now += Time(step(random));
    const double t = limpid::in_seconds(now - start);
    const auto [state, status] = tool.advance(now, One<double>(ramp * t));
    const double x = ramp / k * t - (b + 0.1) * ramp / (k * k);
    // x up to 5 mm and v = 2.5 mm/s: some ten roundings a tick, remembered for fewer than 50
    REQUIRE(std::abs(state.x[0] - x) <= 500 * std::numeric_limits<double>::epsilon() * 5e-3);
    REQUIRE(std::abs(state.v[0] - ramp / k) <= 5000 * std::numeric_limits<double>::epsilon() * 2.5e-3);
  }
}

TEST_CASE("a held force acts from its own tick on, a linear one already on the way to it") {
  const VirtualTool<KelvinVoigt<1>>::Settings held{
      .theta = {{0.0, 0.0}}, .tool = {.mass = 0.5}, .intersample = Intersample::hold};
  auto linear = held;
  linear.intersample = Intersample::linear;
  VirtualTool<KelvinVoigt<1>> with_hold(held), with_line(linear);
  for (auto* tool : {&with_hold, &with_line}) (void)tool->advance(0s, One<double>(0));
  const auto after_hold = with_hold.advance(1s, One<double>(6)).value;
  CHECK(after_hold.x[0] == 0);
  CHECK(after_hold.v[0] == 0);
  CHECK(after_hold.a[0] == 12);  // the force of now
  const auto after_line = with_line.advance(1s, One<double>(6)).value;
  // a = 12 t: v = 6 t^2, x = 2 t^3; the series 1/6, 1/2 are rounded
  CHECK(std::abs(after_line.x[0] - 2) <= 4 * std::numeric_limits<double>::epsilon());
  CHECK(std::abs(after_line.v[0] - 6) <= 12 * std::numeric_limits<double>::epsilon());
}

TEST_CASE("the tool's spring pulls to its anchor, the tangent's offset pushes") {
  // at rest: k_t (x - anchor) + k x + c = F
  VirtualTool<Tangent<2>> tool({.theta = {{800, 30, -5}, {200, 20, 0}},
                                .tool = {.mass = 0.1, .damping = 0.1, .stiffness = 50, .anchor = {0.1, -0.2}}});
  for (int tick = 0; tick <= 5000; ++tick) (void)tool.advance(tick * 1ms, {3, 1});
  // a fixed point of steps with some ten roundings each, remembered for 2 b/k = 100 ticks
  const auto& x = tool.state().x;
  CHECK(std::abs(x[0] - (3.0 + 5.0 + 50 * 0.1) / 850) <= 1000 * std::numeric_limits<double>::epsilon() * 0.016);
  CHECK(std::abs(x[1] - (1.0 - 50 * 0.2) / 250) <= 1000 * std::numeric_limits<double>::epsilon() * 0.036);
}

TEST_CASE("before its first tick the tool is where it starts") {
  VirtualTool<KelvinVoigt<1>> tool(
      {.theta = {{800, 32}}, .tool = {.mass = 0.5}, .x0 = One<double>(0.5), .v0 = One<double>(0.125)});
  CHECK(tool.state().x[0] == 0.5);
  CHECK(tool.state().v[0] == 0.125);
  CHECK(tool.state().force[0] == 404);
  CHECK(tool.state().a[0] == -808);
  CHECK(tool.advance(7s, One<double>(4)).value.x[0] == 0.5);  // the first tick sets the clock
  CHECK(tool.state().a[0] == -800);
}

TEST_CASE("two coupled axes move as their sum and their difference do alone") {
  // K = [[500 300][300 500]], B = [[20 4][4 20]]: eigenvectors (1, 1) and (1, -1), k = 800 and 200, b = 24 and 16
  Eigen::Array<double, 2, 4> theta;
  theta << 500, 300, 20, 4,  //
      300, 500, 4, 20;
  VirtualTool<Coupled<2>> both({.theta = theta, .tool = {.mass = 0.1, .damping = 0.1}});
  VirtualTool<KelvinVoigt<2>> modes({.theta = {{800, 24}, {200, 16}}, .tool = {.mass = 0.1, .damping = 0.1}});
  double worst = 0;
  for (int tick = 0; tick <= 400; ++tick) {
    const Eigen::Array2d F{3 * std::sin(0.02 * tick), 0.005 * tick};
    const auto x = both.advance(tick * 1ms, F).value.x;
    const auto mode = modes.advance(tick * 1ms, {F[0] + F[1], F[0] - F[1]}).value.x;
    worst = maximum(worst, std::abs(x[0] + x[1] - mode[0]), std::abs(x[0] - x[1] - mode[1]));
  }
  // integrated to 1e-15 m or 1e-12 of 10 mm in each of 400 ticks or more
  CHECK(worst < 400 * 1e-14);
}

TEST_CASE("a force that is not finite changes nothing") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const VirtualTool<KelvinVoigt<2>>::Settings settings{.theta = {{800, 30}, {200, 20}}, .tool = {.mass = 0.1}};
  VirtualTool<KelvinVoigt<2>> tool(settings), undisturbed(settings);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    CHECK(tool.advance(0ms, {1, bad}).status == Status::not_finite);  // not yet started
  }
  for (auto* each : {&tool, &undisturbed}) {
    for (int tick = 0; tick < 10; ++tick) (void)each->advance(tick * 1ms, {1, 2});
  }
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    const auto [state, status] = tool.advance(10ms, {bad, 2});
    CHECK((state.x == undisturbed.state().x).all());
    CHECK(status == Status::not_finite);
  }
  CHECK((tool.advance(11ms, {1, 2}).value.x == undisturbed.advance(11ms, {1, 2}).value.x).all());
}

TEST_CASE("a force that would take the tool beyond the scalar's range is refused") {
  VirtualTool<KelvinVoigt<1>> tool({.theta = {{800, 30}}, .tool = {.mass = 0.1}});
  (void)tool.advance(0ms, One<double>(1));
  const auto [state, status] = tool.advance(1ms, One<double>(std::numeric_limits<double>::max()));
  CHECK(state.x[0] == 0);
  CHECK(status == Status::not_finite);
  CHECK(tool.advance(2ms, One<double>(1)).status == Status::ok);
}

TEST_CASE("a clock that does not advance changes nothing") {
  VirtualTool<KelvinVoigt<1>> tool({.theta = {{800, 30}}, .tool = {.mass = 0.1}});
  (void)tool.advance(1ms, One<double>(1));
  const double x = tool.advance(2ms, One<double>(1)).value.x[0];
  for (const Time now : {Time(2ms), Time(1ms)}) {
    const auto [state, status] = tool.advance(now, One<double>(9));
    CHECK(state.x[0] == x);
    CHECK(status == Status::clock_backwards);
  }
}

TEST_CASE("no call allocates, linear or integrated") {
  VirtualTool<KelvinVoigt<3>> exact({.theta = Eigen::Array<double, 3, 2>::Constant(100), .tool = {.mass = 0.1}});
  VirtualTool<Coupled<2>> integrated({.theta = Eigen::Array<double, 2, 4>::Constant(100), .tool = {.mass = 0.1}});
  limpid::test::check_no_allocation([&] {
    for (int tick = 0; tick < 10; ++tick) {
      (void)exact.advance(tick * tick * 1ms, {1, 2, 3});
      (void)integrated.advance(tick * tick * 1ms, {1, 2});
    }
  });
}

TEST_CASE("settings that cannot serve are refused") {
  using Plain = VirtualTool<KelvinVoigt<1>>;
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(Plain({.theta = {{800, 30}}}), "Tool: mass: expected finite and > 0, got 0",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Plain({.theta = {{800, not_a_number}}, .tool = {.mass = 1}}),
                       "VirtualTool: theta: expected finite, got 800 nan", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Plain({.tool = {.mass = 1}, .x0 = One<double>(not_a_number)}),
                       "VirtualTool: x0: expected finite, got nan", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Plain({.tool = {.mass = 1}, .v0 = One<double>(not_a_number)}),
                       "VirtualTool: v0: expected finite, got nan", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Plain({.theta = {{1e300, 0}}, .tool = {.mass = 1}, .x0 = One<double>(1e300)}),
                       "VirtualTool: x0, v0: expected a finite force of the environment, got one that is not",
                       std::invalid_argument);
}
