// SPDX-License-Identifier: MIT
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/smooth_bilinear.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/estimation/tissue_learner.hpp>

#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace {

using namespace limpid;
using namespace std::chrono_literals;
using Law = TissueLaw<5, 16, 96>;
using Learner = TissueLearner<Law>;
using One = Eigen::Array<double, 1, 1>;

Learner::Settings settings() { return {.mass = 0.1, .tool_damping = 0.1}; }

double press(Time now) { return 1.5 * (1 - std::cos(std::numbers::pi * in_seconds(now))); }

// Presses a tissue for `duration` and lets the learner see it each `period`; returns the tissue's tool.
template <typename Env>
VirtualTool<Env> teach(Learner& learner, VirtualTool<Env> tool, Duration duration, Duration period) {
  History<double> forces;
  for (Time now{0}; now <= duration; now += 1ms) {
    (void)forces.push(now, press(now));
    const auto state = tool.advance(now, One(press(now))).value;
    if (now.count() % period.count() == 0) learner.learn({now, state.x[0], state.v[0], state.force[0]}, forces);
  }
  return tool;
}

template <typename Env>
typename VirtualTool<Env>::Settings plant(const Env& env, const EnvironmentTheta<Env>& theta) {
  return {.environment = env, .theta = theta, .tool = {.mass = 0.1, .damping = 0.1}};
}

}  // namespace

TEST_CASE("a linear tissue's stiffness and damping are learnt from four seconds of clean samples") {
  using Env = KelvinVoigt<1>;
  Learner::Settings elastic = settings();
  elastic.relaxation = false;  // a branch of a short lag and a damper are hard to tell apart
  const auto learner = std::make_unique<Learner>(elastic);
  teach(*learner, VirtualTool<Env>(plant(Env{}, {800, 30})), 4s, 32ms);
  // to a thousandth: the samples are exact, the replay's method and its tangents are not
  CHECK(learner->law().elastic(learner->state(), 0.002).slope == doctest::Approx(800).epsilon(1e-3));
  CHECK(learner->law().damping(learner->state(), 0.002) == doctest::Approx(30).epsilon(1e-3));
}

TEST_CASE("a tissue far softer than was believed is learnt from samples that are far apart") {
  using Env = KelvinVoigt<1>;
  const auto learner = std::make_unique<Learner>(settings());
  teach(*learner, VirtualTool<Env>(plant(Env{}, {200, 30})), 8s, 200ms);
  // two hundredths: forty samples, four of them in one press, of a law with five branches that are not there
  for (const double x : {0.002, 0.007, 0.012}) {
    CHECK(learner->law().elastic(learner->state(), x).slope == doctest::Approx(200).epsilon(0.02));
  }
}

TEST_CASE("dry friction is learnt beside stiffness and damping") {
  Learner::Settings sticky = settings();
  sticky.dry_friction = true;
  const auto learner = std::make_unique<Learner>(sticky);
  History<double> forces;
  double x = 0, v = 0, z = 0;  // a tool of 0.1 kg on 800 N/m, 30 N s/m and 0.1 N of friction over 3 um
  for (int tick = 0; tick <= 8000; ++tick) {
    const Time now = tick * 1ms;
    (void)forces.push(now, press(now));
    if (tick % 32 == 0) learner->learn({now, x, v, 800 * x + 30 * v + 0.1 * z}, forces);
    for (int part = 0; part < 100; ++part) {
      const double F = press(now) + (press(now + 1ms) - press(now)) * part / 100, h = 1e-5;
      v += h * (F - 800 * x - 30.1 * v - 0.1 * z) / 0.1;
      x += h * v;
      z = presliding_after(z, v, h, 3e-6);
    }
  }
  CHECK(learner->state()[Law::friction] == doctest::Approx(0.1).epsilon(0.1));  // hardly told from short branches
  CHECK(learner->law().elastic(learner->state(), 0.002).slope == doctest::Approx(800).epsilon(0.02));
}

TEST_CASE("the force of a tissue that stiffens is learnt over the depths that were visited") {
  using Env = SmoothBilinear<1>;
  const Env env({.depth = 0.0028, .sharpness = 20});
  const EnvironmentTheta<Env> theta{370, 1980, 30};
  const auto learner = std::make_unique<Learner>(settings());
  teach(*learner, VirtualTool<Env>(plant(env, theta)), 8s, 32ms);
  for (const double x : {0.0005, 0.0015, 0.0025, 0.0028, 0.0031, 0.0035}) {
    const double truth = EnvironmentTraits<Env>::force(env, theta, One(x), One(0.0))[0];
    // to a thousandth of the largest force, 3 N
    CHECK(learner->law().elastic(learner->state(), x).force == doctest::Approx(truth).epsilon(1e-3).scale(3));
  }
}

TEST_CASE("the state at the newest sample is what was measured, where the measurement is exact") {
  using Env = KelvinVoigt<1>;
  const auto learner = std::make_unique<Learner>(settings());
  const auto tool = teach(*learner, VirtualTool<Env>(plant(Env{}, {800, 30})), 4s, 32ms);
  CHECK(learner->taken() == 4s);
  CHECK(learner->newest().x == doctest::Approx(tool.state().x[0]).epsilon(1e-5));
}

TEST_CASE("a range that outgrows the coefficients is covered by wider knots, the law stays") {
  using Env = KelvinVoigt<1>;
  Learner::Settings fine = settings();
  fine.knot_spacing = 2e-5;  // 96 of them: under 2 mm; the press goes to 7.5 mm
  const auto learner = std::make_unique<Learner>(fine);
  teach(*learner, VirtualTool<Env>(plant(Env{}, {400, 30})), 4s, 32ms);
  CHECK(learner->law().knots().spacing() > 4e-5);
  for (const double x : {0.001, 0.004, 0.007}) {
    CHECK(learner->law().elastic(learner->state(), x).slope == doctest::Approx(400).epsilon(0.01));
  }
}

TEST_CASE("after a gap without forces learning starts again from the sample and keeps the law") {
  using Env = KelvinVoigt<1>;
  const auto learner = std::make_unique<Learner>(settings());
  teach(*learner, VirtualTool<Env>(plant(Env{}, {800, 30})), 4s, 32ms);
  const double slope = learner->law().elastic(learner->state(), 0.002).slope;
  const History<double> none;
  learner->learn({10s, 0.001, 0.0, 0.8}, none);
  CHECK(learner->taken() == 10s);
  CHECK(learner->newest().x == 0.001);
  CHECK(learner->law().elastic(learner->state(), 0.002).slope == doctest::Approx(slope).epsilon(0.01));
}

TEST_CASE("learning asks for no memory") {
  using Env = KelvinVoigt<1>;
  const auto learner = std::make_unique<Learner>(settings());
  VirtualTool<Env> tool(plant(Env{}, {800, 30}));
  limpid::test::check_no_allocation([&] { tool = teach(*learner, tool, 500ms, 100ms); });
}

TEST_CASE("a learner's settings that cannot serve are refused by name") {
  Learner::Settings bad = settings();
  bad.mass = 0;
  CHECK_THROWS_WITH_AS(Learner{bad}, "TissueLearner: mass: expected finite and > 0, got 0", std::invalid_argument);
  bad = settings();
  bad.knot_spacing = -1e-5;
  CHECK_THROWS_WITH_AS(Learner{bad}, "TissueLearner: knot_spacing: expected finite and > 0, got -1e-05",
                       std::invalid_argument);
  bad = settings();
  bad.iterations = 0;
  CHECK_THROWS_WITH_AS(Learner{bad}, "TissueLearner: iterations: expected 1 to 20, got 0", std::invalid_argument);
}
