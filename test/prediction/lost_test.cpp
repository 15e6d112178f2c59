// SPDX-License-Identifier: MIT
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/unilateral.hpp>
#include <limpid/prediction/model_predictor.hpp>
#include <limpid/signal/delayed_sampled.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>

namespace {

using namespace limpid;
using namespace std::chrono_literals;
using Wall = Unilateral<KelvinVoigt<1>>;
using One = Eigen::Array<double, 1, 1>;
using WallPredictor = ModelPredictor<Wall, Tool<1>, Known>;

const EnvironmentTheta<Wall> theta{800, 30};

// The thesis's gain for 100 ms, which free space does not damp.
WallPredictor predictor() {
  return WallPredictor({.environment = Wall({}),
                        .tool = {.mass = 0.1, .damping = 0.1},
                        .theta = theta,
                        .gain = ConstantGain<1>(-195.1, -4.89)});
}

}  // namespace

TEST_CASE("in free space under a gain for contact a prediction that runs away starts again from the samples") {
  // 1 cm outside the wall nothing draws the tool back but L, once each 100 ms and 100 ms late
  const One away(-0.01);
  WallPredictor p({.environment = Wall({}),
                   .tool = {.mass = 0.1, .damping = 0.1},
                   .theta = theta,
                   .gain = ConstantGain<1>(-195.1, -4.89),
                   .start = {.x = One(-0.011)}});
  DelayedSampled<ToolState<1>> sampled({.period = 100ms, .delay = 100ms});
  ToolState<1> tool;
  tool.x = away;
  int times_lost = 0;
  for (auto now = 0ms; now <= 20s; now += 1ms) {
    const auto& seen = sampled.update(now, tool);
    if (seen.fresh) (void)p.observe({seen.value, seen.taken, seen.arrived});
    const auto [motion, status] = p.advance(now, One(0.0));
    if (has(status, Status::lost)) ++times_lost;
    // an error that is just not seen as lost draws with 19.5 N on 0.1 kg for the time between two samples: 1 m
    CHECK(std::abs(motion.x[0] - away[0]) < 2);
  }
  CHECK(times_lost >= 2);
}

TEST_CASE("one sample that is far off changes nothing but the feedback until the next one") {
  WallPredictor p = predictor(), undisturbed = predictor();
  ToolState<1> tool;
  for (auto now = 0ms; now <= 300ms; now += 1ms) {
    ToolState<1> wrong = tool;
    if (now == 100ms) wrong.x[0] = 1e6;
    if (now.count() % 100 == 0) {
      (void)p.observe({wrong, now, now});
      (void)undisturbed.observe({tool, now, now});
    }
    const auto mine = p.advance(now, One(0.0));
    CHECK(mine.motion.x[0] == undisturbed.advance(now, One(0.0)).motion.x[0]);
    CHECK(has(mine.status, Status::lost) == (now == 100ms));
  }
}

TEST_CASE("a bound that is not positive is refused") {
  CHECK_THROWS_WITH_AS(
      WallPredictor({.environment = Wall({}), .tool = {.mass = 0.1}, .theta = theta, .lost_beyond = 0}),
      "ModelPredictor: lost_beyond: expected > 0, got 0", std::invalid_argument);
}
