// SPDX-License-Identifier: MIT
#include <limpid/estimation/tissue_belief.hpp>
#include <limpid/estimation/tissue_law.hpp>
#include <limpid/estimation/tissue_learner_settings.hpp>
#include <limpid/estimation/tissue_replay.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace {

using namespace limpid;
using namespace std::chrono_literals;
using Law = TissueLaw<2, 8, 48>;
using State = Law::State;
using Replay = TissueReplay<Law, 256>;
using Vector = Eigen::Vector3d;

TissueLearnerSettings<Law> settings(bool relaxation, bool friction) {
  TissueLearnerSettings<Law> s;
  s.mass = 0.1;
  s.tool_damping = 0.1;
  s.knot_spacing = 2e-4;
  s.relaxation = relaxation;
  s.dry_friction = friction;
  s.presliding = 3e-4;  // smooth over a step, so that a difference of paths has a limit
  return s;
}

// A law that holds depths from -1 to 4 mm, and a path of 60 ms in it.
struct Scene {
  explicit Scene(const TissueLearnerSettings<Law>& s, Duration tick = 1ms)
      : belief({s.curvature, s.damping_change, s.most_slope, s.most_damping}, Law(s.law(), 0.0)) {
    belief.extend(-1e-3, 4e-3);
    for (Time now{0}; now <= 60ms; now += tick) forces.append(now, 2 - 2 * std::cos(50 * in_seconds(now)));
    REQUIRE(replay->find_steps(belief.law, forces, Time{0}, sample.taken));
  }

  // Measured less replayed, from a state.
  Vector misfit(const State& s) {
    REQUIRE(replay->walk(belief.law, s, memory, sample));
    replay->compare(belief.law, s, sample, false, evaluation);
    REQUIRE(replay->linearise(belief.law, s, sample, false, evaluation));
    return evaluation.y;
  }

  TissueBelief<Law> belief;
  std::unique_ptr<Replay> replay = std::make_unique<Replay>();
  History<double, 256> forces;
  AxisSample<double> sample{.taken = 60ms, .x = 1.2e-3, .v = 0.02, .force = 0.5};
  Law::Memory memory{.chi = {1e-4, 2e-4}, .bristle = 0.3};
  Replay::Evaluation evaluation;
};

State random_law(const Law& law, std::mt19937& generator) {
  std::uniform_real_distribution<double> unit;
  State s = State::Zero();
  s[Law::position] = 5e-4 * unit(generator);
  s[Law::velocity] = 1e-2 * unit(generator);
  s[Law::residual] = 0.1 * unit(generator);
  if (law.settings().dry_friction) s[Law::friction] = 0.2 * unit(generator);
  if (law.settings().relaxation) s.segment<2>(Law::first_branch).setConstant(100 * unit(generator));
  const double k = 200 + 1800 * unit(generator), b = 10 + 30 * unit(generator);
  for (int j = law.dampers().low; j <= law.dampers().high; ++j) s[Law::damper(j)] = b + 2 * unit(generator);
  for (int j = law.knots().low(); j <= law.knots().high(); ++j) {
    s[Law::coefficient(j)] = k * j * law.knots().spacing() + 0.01 * unit(generator);
  }
  return s;
}

void check_derivatives(Scene& scene, const State& s) {
  (void)scene.misfit(s);
  const Replay::Rows H = scene.evaluation.H;
  const Eigen::RowVector3d largest = H.cwiseAbs().colwise().maxCoeff();
  for (int i = 0; i < Law::states; ++i) {
    if (H.row(i).isZero()) continue;
    // of a parameter's own size: forces of some millinewton, so that the path stays within the tangent
    const double size = i < 2 ? 1e-6 : i < Law::first_branch ? 1e-4 : i < Law::first_coefficient ? 1e-2 : 1e-4;
    State more = s, less = s;
    more[i] += size;
    less[i] -= size;
    const Vector slope = (scene.misfit(less) - scene.misfit(more)) / (2 * size);
    CAPTURE(i);
    for (int k = 0; k < 3; ++k) {
      // What is linear over a step in the adjoint, the force's share of each parameter, is smooth in the step of the
      // replay: (h b/m)^2/12 of what the last steps give, h = 1 ms, b/m up to 400/s.
      CHECK(std::abs(H(i, k) - slope[k]) <= 0.014 * std::abs(slope[k]) + 0.002 * largest[k]);
    }
  }
}

void check_derivatives(bool relaxation, bool friction, unsigned seed) {
  CAPTURE(seed);
  Scene scene(settings(relaxation, friction));
  std::mt19937 generator(seed);
  check_derivatives(scene, random_law(scene.belief.law, generator));
}

// The tool starts outside and meets an edge at .6 mm, at a speed in m/s.
void check_derivatives_of_contact(double speed, bool remembers, unsigned seed) {
  CAPTURE(seed);
  // The step is parted at the edge, and what the mean velocity of its second part errs by hangs on the instant: steps
  // of a quarter of a millisecond, that it be small beside the tolerance.
  Scene scene(settings(remembers, remembers), 250us);
  scene.belief.law.begin_at_edge();
  std::mt19937 generator(seed);
  State s = random_law(scene.belief.law, generator);
  const auto edge = scene.belief.law.elastic(s, 6e-4);
  for (int j = scene.belief.law.knots().low(); j <= scene.belief.law.knots().high(); ++j) {
    s[Law::coefficient(j)] -= edge.force;
  }
  s[Law::position] = -2e-4;
  s[Law::velocity] = speed;
  s[Law::residual] = 0;
  scene.memory = {};
  check_derivatives(scene, s);
}

}  // namespace

TEST_CASE("what x, v and the force at a path's end have of each parameter is what differences of paths say") {
  for (unsigned seed = 1; seed <= 5; ++seed) check_derivatives(false, false, seed);
}

TEST_CASE("with branches that relax, the force that they push back with is in the derivatives") {
  for (unsigned seed = 1; seed <= 5; ++seed) check_derivatives(true, false, seed);
}

TEST_CASE("with dry friction, so is the bristle's") {
  for (unsigned seed = 1; seed <= 5; ++seed) check_derivatives(true, true, seed);
}

TEST_CASE("the gain of a constant force is that of the residual force where that does not fade") {
  auto lasting = settings(false, false);
  lasting.residual_time = 1e9;
  Scene scene(lasting);
  std::mt19937 generator(7);
  (void)scene.misfit(random_law(scene.belief.law, generator));
  CHECK(scene.evaluation.x_gain == doctest::Approx(scene.evaluation.H(Law::residual, 0)).epsilon(1e-9));
  CHECK(scene.evaluation.v_gain == doctest::Approx(scene.evaluation.H(Law::residual, 1)).epsilon(1e-9));
}

TEST_CASE(
    "where the tool meets a tissue's edge, what the instant has of the law and of the start is in the derivatives") {
  for (unsigned seed = 1; seed <= 5; ++seed) check_derivatives_of_contact(0.04, false, seed);
  for (unsigned seed = 1; seed <= 5; ++seed) check_derivatives_of_contact(0.04, true, seed);
}

TEST_CASE("so it is where the tool bounces off") {
  for (unsigned seed = 1; seed <= 5; ++seed) check_derivatives_of_contact(0.3, false, seed);
}
