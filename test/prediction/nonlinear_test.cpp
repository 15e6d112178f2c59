// SPDX-License-Identifier: MIT
#include <limpid/environment/coupled.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <support/maximum.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>

using limpid::Known;
using limpid::ModelPredictor;
using limpid::Time;
using limpid::Tool;
using limpid::test::largest_entry;
using limpid::test::maximum;
using namespace std::chrono_literals;

namespace {

/// Largest position error over a press of 1 s against the tool integrated to 1e-12.
template <typename Env>
double worst_over_press(const Env& environment, const limpid::EnvironmentTheta<Env>& theta, Time tick) {
  using Vector = limpid::EnvironmentVector<Env>;
  constexpr int axes = limpid::EnvironmentTraits<Env>::axes;
  const Tool<axes> tool{.mass = 0.1, .damping = 0.1, .stiffness = 1};
  limpid::VirtualTool<Env> ideal({.environment = environment, .theta = theta, .tool = tool});
  ModelPredictor<Env, Tool<axes>, Known> predictor({.environment = environment, .tool = tool, .theta = theta});
  double worst = 0;
  for (Time now{}; now <= 1s; now += tick) {
    const double t = limpid::in_seconds(now);
    // straight pieces of 20 ms, whatever the tick, so that both see the same force
    const double from = std::floor(t / 0.02 + 1e-9) * 0.02, part = (t - from) / 0.02;
    const auto press = [](double s) { return 3 * (1 - std::cos(2 * M_PI * s)); };
    const Vector F = Vector::Constant(press(from) + (press(from + 0.02) - press(from)) * part);
    const auto truth = ideal.advance(now, F).value;
    worst = maximum(worst, largest_entry(predictor.advance(now, F).motion.x - truth.x));
  }
  return worst;
}

}  // namespace

// A soft layer on a hard one: 200 N/m to 8 mm, then 2000. The press goes to some 10 mm.
TEST_CASE("in a nonlinear environment halving the tick divides the error by eight") {
  const limpid::SmoothBilinear<1> layers({.depth = 0.008, .sharpness = 20});
  const limpid::SmoothBilinear<1>::Theta theta(200, 2000, 20);
  const double coarse = worst_over_press(layers, theta, 4ms), fine = worst_over_press(layers, theta, 2ms),
               finest = worst_over_press(layers, theta, 1ms);
  MESSAGE("worst error in m at 4, 2, 1 ms: ", coarse, " ", fine, " ", finest);
  CHECK(fine < coarse / 6);  // order 3, less terms of higher order
  CHECK(finest < fine / 6);
  CHECK(finest < 1e-7);  // of 10 mm
}

TEST_CASE("axes that feel each other are followed to order two") {
  using Env = limpid::Coupled<2>;
  Env::Theta theta;  // rows of K, then of B
  theta << 900, 200, 30, 5, 150, 700, 4, 25;
  const double coarse = worst_over_press(Env{}, theta, 2ms), fine = worst_over_press(Env{}, theta, 1ms);
  MESSAGE("worst error in m at 2, 1 ms: ", coarse, " ", fine);
  CHECK(fine < coarse / 3.5);
  CHECK(fine < 1e-7);
}
