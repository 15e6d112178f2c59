// SPDX-License-Identifier: MIT
#include "design/palpation.hpp"

#include <limpid/design/sampled_stability.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <limpid/signal/delayed_sampled.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>

using limpid::Gain;
using limpid::SampledStability;
using limpid::SampledSystem;
using limpid::Tool;
using limpid::test::tool;
using namespace std::chrono_literals;

TEST_CASE("the monodromy matrix takes the library's own predictor from sample to sample") {
  using Env = limpid::KelvinVoigt<1>;
  using Predictor = limpid::ModelPredictor<Env, Tool<1>, limpid::Known>;
  using One = Eigen::Array<double, 1, 1>;
  const Gain<double> L(-120, -3);
  for (const limpid::Duration delay : {0ms, 5ms, 8ms, 20ms, 27ms, 40ms, 63ms}) {
    CAPTURE(delay.count());
    Predictor::Settings settings{.environment = {}, .tool = tool, .theta = Env::Theta(600, 25)};
    Predictor truth(settings);
    settings.start = {.x = One(0.001), .v = One(-0.02)};
    settings.gain = {L[0], L[1]};
    Predictor predictor(settings);
    limpid::DelayedSampled<limpid::ToolState<1>> sampled({.period = 20ms, .delay = delay});

    const SampledSystem<double> system{tool, 0.02, std::chrono::duration<double>(delay).count()};
    const Eigen::MatrixXd M = SampledStability<double>(system).monodromy({600, 25}, L);
    Eigen::VectorXd z = Eigen::VectorXd::Zero(M.rows());
    z.head(2) << 0.001, -0.02;
    for (limpid::Time now{}; now <= 400ms; now += 1ms) {
      const auto exact = truth.advance(now, One(0)).motion;
      const auto seen = sampled.update(now, {exact.x, exact.v, exact.a, One(0)});
      if (seen.fresh) REQUIRE(predictor.observe({seen.value, seen.taken, seen.arrived}) == limpid::Status::ok);
      const auto predicted = predictor.advance(now, One(0)).motion;
      if (now % 20ms != limpid::Duration::zero()) continue;
      // 400 steps on sizes up to those of the start.
      CHECK(std::abs(predicted.x[0] - exact.x[0] - z[0]) < 1e-3 * 1e-11);
      CHECK(std::abs(predicted.v[0] - exact.v[0] - z[1]) < 2e-2 * 1e-11);
      z = Eigen::VectorXd(M * z);
    }
  }
}
