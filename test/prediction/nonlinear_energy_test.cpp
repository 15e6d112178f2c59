// SPDX-License-Identifier: MIT
// Stiff nonlinear contact of light, undamped tools in long ticks.
#include <limpid/prediction/model_predictor.hpp>

#include <stress/estimator_scenario.hpp>
#include <stress/potential.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

using namespace limpid;
using namespace std::chrono_literals;

namespace {

template <typename Env>
using Following = ModelPredictor<Env, Tool<1>, Known>;

/// Largest energy over that at the start, of 3000 ticks without force.
template <typename Env>
double largest_energy(const EnvironmentTheta<Env>& theta, double mass, double start, Duration tick) {
  const Env environment = stress::environment_of<Env>();
  typename Following<Env>::Settings settings{.environment = environment, .tool = {.mass = mass}, .theta = theta};
  settings.start.x[0] = start;
  Following<Env> predictor(settings);
  const auto energy = [&](double x, double v) {
    return mass * v * v / 2 + stress::potential_of(environment, theta.transpose(), x).energy;
  };
  double largest = 0;
  Time now{};
  for (int i = 0; i < 3000; ++i, now += tick) {
    const auto motion = predictor.advance(now, EnvironmentVector<Env>::Zero()).motion;
    largest = std::max(largest, energy(motion.x[0], motion.v[0]));
  }
  return largest / energy(start, 0);
}

// What one step may add, 4/3 of a change of tangent of an eighth (see PredictorStress); over many the signs change.
constexpr double most = 1 + 1.0 / 6;

}  // namespace

TEST_CASE("an undamped contact of Hunt and Crossley gains no energy in long ticks") {
  const HuntCrossley<1>::Theta theta(1500, 0, 0);
  CHECK(largest_energy<HuntCrossley<1>>(theta, 0.1, 0.01, 10ms) <= most);
  CHECK(largest_energy<HuntCrossley<1>>(theta, 0.001, 0.01, 1ms) <= most);
  CHECK(largest_energy<HuntCrossley<1>>(theta, 0.001, 0.01, 50ms) <= most);
}

TEST_CASE("a lightly damped smooth corner gains no energy in long ticks") {
  const SmoothBilinear<1>::Theta theta(500, 2000, 1);
  CHECK(largest_energy<SmoothBilinear<1>>(theta, 0.1, 0.01, 20ms) <= most);
}

TEST_CASE("a tool that leaves an undamped wall in a long tick gains no energy") {
  using Wall = Unilateral<KelvinVoigt<1>>;
  CHECK(largest_energy<Wall>({1e5, 0}, 0.1, 0.001, 50ms) <= most);
  CHECK(largest_energy<Wall>({1e6, 0}, 0.001, 0.001, 1ms) <= most);
}

TEST_CASE("a force on a light tool presses it no deeper into a stiff contact than its work allows") {
  constexpr double k = 1e6, N = 1.3, F = 1;
  const double deepest = std::pow((N + 1) * F / k, 1 / N);  // F x = k x^(N+1)/(N+1)
  for (const Duration tick : {1ms, 10ms, 50ms}) {
    Following<HuntCrossley<1>> predictor(
        {.environment = HuntCrossley<1>({.exponent = N}), .tool = {.mass = 0.001}, .theta = {k, 0, 1}});
    double largest = 0;
    Status status = Status::ok;
    Time now{};
    Motion<1> last;
    for (int i = 0; i < 2000; ++i, now += tick) {
      const auto [motion, of_tick] = predictor.advance(now, EnvironmentVector<HuntCrossley<1>>::Constant(F));
      largest = std::max(largest, std::abs(motion.x[0]));
      status |= of_tick;
      last = motion;
    }
    CHECK(largest <= deepest);
    CHECK(last.x[0] == doctest::Approx(std::pow(F / k, 1 / N)));  // at rest, k x^N = F
    CHECK_FALSE(has(status, Status::not_finite));
  }
}

TEST_CASE("a tick that is too long for its stiffness is said to be coarse, an ordinary one is not") {
  const auto first_step = [](double mass, Duration tick) {
    Following<HuntCrossley<1>>::Settings settings{
        .environment = HuntCrossley<1>({.exponent = 1.3}), .tool = {.mass = mass}, .theta = {1e6, 0, 0}};
    settings.start.x[0] = 0.01;
    Following<HuntCrossley<1>> predictor(settings);
    (void)predictor.advance(Time{}, EnvironmentVector<HuntCrossley<1>>::Zero());
    return predictor.advance(Time{} + tick, EnvironmentVector<HuntCrossley<1>>::Zero()).status;
  };
  CHECK(has(first_step(0.001, 50ms), Status::coarse));  // some 300 periods
  CHECK_FALSE(has(first_step(0.1, 1ms), Status::coarse));
}
