// SPDX-License-Identifier: MIT
#include <limpid/environment/hunt_crossley.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/unilateral.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <support/maximum.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

using limpid::HuntCrossley;
using limpid::KelvinVoigt;
using limpid::SmoothBilinear;
using limpid::Status;
using limpid::Unilateral;
using limpid::VirtualTool;
using limpid::test::maximum;
using namespace std::chrono_literals;

namespace {

using One = Eigen::Array<double, 1, 1>;

// Kelvin-Voigt that does not say that it is linear
struct Unaware : KelvinVoigt<1> {
  static constexpr bool linear = false;
};

// The classical Runge-Kutta step of x'' = acceleration(t, x, v)
template <typename F>
std::pair<double, double> classical_step(double t, double x, double v, double h, const F& acceleration) {
  const double a1 = acceleration(t, x, v);
  const double x2 = x + h / 2 * v, v2 = v + h / 2 * a1, a2 = acceleration(t + h / 2, x2, v2);
  const double x3 = x + h / 2 * v2, v3 = v + h / 2 * a2, a3 = acceleration(t + h / 2, x3, v3);
  const double x4 = x + h * v3, v4 = v + h * a3, a4 = acceleration(t + h, x4, v4);
  return {x + h / 6 * (v + 2 * v2 + 2 * v3 + v4), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)};
}

}  // namespace

TEST_CASE("the integrated trajectory of a linear environment is the exact one") {
  VirtualTool<KelvinVoigt<1>> exact({.theta = {{2000, 25}}, .tool = {.mass = 0.1, .stiffness = 1}});
  VirtualTool<Unaware> integrated({.theta = {{2000, 25}}, .tool = {.mass = 0.1, .stiffness = 1}});
  double worst_x = 0, worst_v = 0;
  for (int tick = 0; tick <= 2000; ++tick) {
    const One F(3 * std::sin(1e-3 * std::numbers::pi * tick));
    const auto a = exact.advance(tick * 1ms, F).value, b = integrated.advance(tick * 1ms, F).value;
    worst_x = maximum(worst_x, std::abs(a.x[0] - b.x[0]));
    worst_v = maximum(worst_v, std::abs(a.v[0] - b.v[0]));
  }
  // 1e-15 in m and m/s or 1e-12 of x = 1.5 mm and v = 5 mm/s in each step, remembered for 1/(b/2m) = 8 ticks
  CHECK(worst_x < 8 * 1e-14);
  CHECK(worst_v < 8 * 1e-14);
}

TEST_CASE("in the smooth bilinear tissue it agrees with a thousand classical Runge-Kutta steps a tick") {
  const SmoothBilinear<1> tissue({.depth = 0.00284, .sharpness = 20});
  const Eigen::Array<double, 1, 3> theta{200, 2000, 30};
  VirtualTool<SmoothBilinear<1>> tool({.environment = tissue, .theta = theta, .tool = {.mass = 0.1, .damping = 0.1}});
  const auto force_at = [](double t) { return 2.5 - 2.5 * std::cos(20 * t); };
  double x = 0, v = 0, worst_x = 0, worst_v = 0;
  (void)tool.advance(0ms, One(force_at(0)));
  for (int tick = 1; tick <= 200; ++tick) {
    const double start = (tick - 1) * 1e-3, F0 = force_at(start), F1 = force_at(tick * 1e-3);
    for (int i = 0; i < 1000; ++i) {
      std::tie(x, v) = classical_step(i * 1e-6, x, v, 1e-6, [&](double t, double at, double rate) {
        return (F0 + (F1 - F0) * t / 1e-3 - 0.1 * rate - tissue.force(theta, One(at), One(rate))[0]) / 0.1;
      });
    }
    const auto state = tool.advance(tick * 1ms, One(F1)).value;
    worst_x = maximum(worst_x, std::abs(state.x[0] - x));
    worst_v = maximum(worst_v, std::abs(state.v[0] - v));
  }
  // Local errors of 1e-12 of x = 4 mm, remembered for b/k1 = 150 ticks, and of v = 60 mm/s, for m/b = 3 ticks, beside
  // what x pulls along. The reference's own truncation is (300/s 1 us)^4 = 1e-14 of them.
  CHECK(worst_x < 150 * 1e-12 * 4e-3);
  CHECK(worst_v < 10 * 1e-12 * 6e-2);
}

TEST_CASE("without damping a tool in a Hunt-Crossley contact keeps its energy") {
  const double m = 0.1, k = 1500, N = 1.3, F = 5;
  VirtualTool<HuntCrossley<1>> tool(
      {.environment = HuntCrossley<1>({.exponent = N}), .theta = {{k, 0.0, 0.0}}, .tool = {.mass = m}});
  (void)tool.advance(0ms, One(F));
  double worst = 0, deepest = 0;
  for (int tick = 1; tick <= 1000; ++tick) {
    const auto state = tool.advance(tick * 1ms, One(F)).value;
    const double x = state.x[0], v = state.v[0];
    worst = maximum(worst, std::abs(m / 2 * v * v + k / (N + 1) * std::pow(std::abs(x), N + 1) - F * x));
    deepest = maximum(deepest, x);
  }
  // it swings between 0 and (F (N + 1)/k)^(1/N) = 24.6 mm, seen at ticks of 1 ms; F x at the deepest is 0.12 J
  CHECK(deepest == doctest::Approx(std::pow(F * (N + 1) / k, 1 / N)).epsilon(1e-3));
  // local errors of 1e-12 over 1000 ticks or more, added at worst; at x = 0 the force is not smooth and the steps get
  // short
  CHECK(worst < 1e-9 * F * deepest);
}

TEST_CASE("a tool outside a unilateral wall flies freely, strikes, and leaves as fast as it came") {
  const double k = 1000, m = 0.1;
  VirtualTool<Unilateral<KelvinVoigt<1>>> tool({.environment = Unilateral<KelvinVoigt<1>>({}),
                                                .theta = {{k, 0}},
                                                .tool = {.mass = m},
                                                .x0 = One(-0.01),
                                                .v0 = One(0.5)});
  (void)tool.advance(0ms, One(0));
  // contact after 20 ms, half a swing of pi sqrt(m/k) = 31.416 ms, then back out
  for (int tick = 1; tick <= 19; ++tick) (void)tool.advance(tick * 1ms, One(0));
  CHECK(tool.state().x[0] == doctest::Approx(-0.0005).epsilon(1e-12));
  CHECK(tool.state().force[0] == 0);
  for (int tick = 20; tick <= 36; ++tick) CHECK(tool.advance(tick * 1ms, One(0)).status == Status::ok);
  const double omega = std::sqrt(k / m);
  CHECK(std::abs(tool.state().x[0] - 0.5 / omega * std::sin(omega * 0.016)) < 1e-10 * 0.005);
  for (int tick = 37; tick <= 60; ++tick) (void)tool.advance(tick * 1ms, One(0));
  CHECK(tool.state().v[0] == doctest::Approx(-0.5).epsilon(1e-10));
  CHECK(std::abs(tool.state().x[0] + 0.5 * (0.06 - 0.02 - std::numbers::pi / omega)) < 1e-10);
  CHECK(tool.state().force[0] == 0);
}

TEST_CASE("a wall with damping strikes with a jump of force, in float too") {
  using Wall = Unilateral<KelvinVoigt<1, float>>;
  VirtualTool<Wall> tool({.environment = Wall({}),
                          .theta = {{1000.0F, 30.0F}},
                          .tool = {.mass = 0.1F},
                          .x0 = Eigen::Array<float, 1, 1>(-0.01F)});
  for (int tick = 0; tick <= 2000; ++tick) {
    CAPTURE(tick);
    REQUIRE(tool.advance(tick * 1ms, Eigen::Array<float, 1, 1>(2)).status == Status::ok);
  }
  CHECK(tool.state().x[0] == doctest::Approx(0.002).epsilon(1e-4));  // rest at F/k, to the integrator's 2e-6 a step
}

TEST_CASE("a force beyond the integrator's reach changes nothing") {
  VirtualTool<Unaware> tool({.theta = {{800, 30}}, .tool = {.mass = 0.1}});
  (void)tool.advance(0ms, One(1));
  const auto [state, status] = tool.advance(1ms, One(std::numeric_limits<double>::max()));
  CHECK(status == Status::not_finite);
  CHECK(state.x[0] == 0);
  CHECK(tool.advance(2ms, One(1)).status == Status::ok);
}

// A rate of b/m = 3e4 1/s: half a second takes more steps than the integrator has.
TEST_CASE("a tool that a pause has lost is stopped in the second call, and moves on from there") {
  using Model = HuntCrossley<1>;
  VirtualTool<Model> tool({.environment = Model({.exponent = 1.3}),
                           .theta = {{1500.0, 0.0, 30.0}},
                           .tool = {.mass = 1e-3, .damping = 0.1}});
  for (int tick = 0; tick < 20; ++tick) REQUIRE(tool.advance(tick * 1ms, One(1)).status == Status::ok);
  const auto before = tool.state();
  const auto lost = tool.advance(519ms, One(1));
  CHECK(lost.status == Status::limited);
  CHECK(lost.value.x[0] == before.x[0]);
  CHECK(lost.value.v[0] == before.v[0]);
  const auto stopped = tool.advance(520ms, One(1));
  CHECK(stopped.status == Status::limited);
  CHECK(stopped.value.x[0] == before.x[0]);
  CHECK(stopped.value.v[0] == 0);
  // (3.29) at rest
  CHECK(stopped.value.a[0] == doctest::Approx((1 - stopped.value.force[0]) / 1e-3).epsilon(1e-12));
  for (int tick = 521; tick < 600; ++tick) REQUIRE(tool.advance(tick * 1ms, One(1)).status == Status::ok);
}
