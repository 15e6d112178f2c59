// SPDX-License-Identifier: MIT
// A tissue that begins at an edge, F = max(0, k (x - e) + b v) beyond it: the law's steps against the closed form of
// the flight and of the damped oscillator, and what the learner makes of it.
#include <limpid/estimation/tissue_belief.hpp>
#include <limpid/estimation/tissue_learner.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>

namespace {

using namespace limpid;
using namespace std::chrono_literals;

constexpr double mass = 0.1, k = 1500, b = 10, edge = 1e-3;

struct State {
  double x, v;
};

// Of m x'' = -k (x - edge) - b v, underdamped, t after the edge was met at v.
State pressed(double t, double v) {
  const double decay = b / (2 * mass), omega = std::sqrt(k / mass - decay * decay);
  const double e = std::exp(-decay * t), s = std::sin(omega * t), c = std::cos(omega * t);
  return {edge + v / omega * e * s, v * e * (c - decay / omega * s)};
}

// When the tissue lets go: k x + b v = 0.
double released() {
  const double decay = b / (2 * mass), omega = std::sqrt(k / mass - decay * decay);
  return (std::numbers::pi - std::atan(b * omega / (k - b * decay))) / omega;
}

// A free tool that bounces at v.
State bounced(double t, double from, double v) {
  const double met = (edge - from) / v, left = released();
  if (t < met) return {from + v * t, v};
  if (t < met + left) return pressed(t - met, v);
  const State end = pressed(left, v);
  return {end.x + end.v * (t - met - left), end.v};
}

using Law = TissueLaw<2, 8, 48>;

// The law with an edge whose force is k (x - edge) + b v.
struct Wall {
  Wall()
      : law({.mass = mass, .knot_spacing = 2e-4, .damper_spacing = 1e-3, .residual_time = 1, .most_damping = 200}, 0) {
    TissueBelief<Law> belief({.curvature = 1, .damping_change = 1, .most_slope = 1e4, .most_damping = 200}, law);
    belief.extend(-1e-3, 4e-3);
    law = belief.law;
    law.begin_at_edge();
    for (int j = law.knots().low(); j <= law.knots().high(); ++j) {
      s[Law::coefficient(j)] = k * (j * law.knots().spacing() - edge);
    }
    for (int j = law.dampers().low; j <= law.dampers().high; ++j) s[Law::damper(j)] = b;
  }

  Law law;
  Law::State s = Law::State::Zero();
};

// A tool that is pressed against a wall, by steps of 1 us.
struct PressedWall {
  [[nodiscard]] double force() const { return x > edge ? std::max(k * (x - edge) + 30 * v, 0.0) : 0; }
  void advance(double F0, double F1) {
    for (int i = 0; i < 1000; ++i) {
      v += 1e-6 / mass * (F0 + (F1 - F0) * i / 1000 - 0.1 * v - force());
      x += 1e-6 * v;
    }
  }

  double x = 0, v = 0;
};

double press(double t) { return 1.5 * (1 - std::cos(std::numbers::pi * t)); }

TissueLearnerSettings<TissueLaw<>> settings() {
  TissueLearnerSettings<TissueLaw<>> settings;
  settings.mass = mass;
  settings.tool_damping = 0.1;
  settings.contact = true;
  return settings;
}

}  // namespace

TEST_CASE("a tool bounces off a tissue's edge as the closed form has it, whenever in a step it meets that") {
  for (const double from : {-1e-3, -1.003e-3, -0.991e-3}) {
    Wall wall;
    Law::Point p{.x = from, .v = 0.1, .residual = 0, .memory = {}};
    for (int tick = 1; tick <= 60; ++tick) {
      wall.law.step<false>(wall.s, p, 0, 0, 1e-3);
      const State expected = bounced(tick * 1e-3, from, 0.1);
      // the method's error, (omega h)^5/120 of the motion a step, for the twenty steps of the contact: 3e-6
      CHECK(std::abs(p.x - expected.x) < 1e-5 * 1e-3);
      CHECK(std::abs(p.v - expected.v) < 1e-5 * 0.1);
    }
  }
}

TEST_CASE("the force is that of the law beyond the edge, and none outside nor where it would pull") {
  const Wall wall;
  const auto force = [&](double x, double v) { return wall.law.force(wall.s, {x, v, 0, {}}); };
  CHECK(force(0.5e-3, 0.1) == 0);
  CHECK(force(2e-3, 0.1) == doctest::Approx(k * 1e-3 + b * 0.1));
  CHECK(force(2e-3, -0.2) == 0);
}

TEST_CASE("the pieces of a step in which the edge is met fill it, and say how the force jumps") {
  Wall wall;
  Law::Point p{.x = edge - 2e-5, .v = 0.1, .residual = 0, .memory = {}};
  double length = 0, jump = 0;
  int pieces = 0;
  wall.law.step<false>(wall.s, p, 0, 0, 1e-3, [&](const Law::Point&, const Law::Piece& piece) {
    length += piece.length;
    jump += piece.jump;
    ++pieces;
  });
  CHECK(pieces == 2);
  CHECK(length == doctest::Approx(1e-3));
  CHECK(jump == doctest::Approx(b * 0.1).epsilon(1e-6));  // at the edge the spring is not stretched
}

TEST_CASE("a wall that is first met in free flight is learnt: its edge, slope and damping") {
  const auto learner = std::make_unique<TissueLearner<>>(settings());
  PressedWall wall;
  History<double> forces;
  for (int tick = 0; tick <= 8000; ++tick) {
    (void)forces.push(tick * 1ms, press(tick * 1e-3));
    if (tick % 32 == 0) learner->learn({tick * 1ms, wall.x, wall.v, wall.force()}, forces);
    wall.advance(press(tick * 1e-3), press((tick + 1) * 1e-3));
  }
  REQUIRE(learner->law().contact());
  const auto elastic = [&](double x) { return learner->law().elastic(learner->state(), x); };
  // a thousandth of the largest force, and of the slope and the damping: as for a linear tissue in tissue_learner_test
  CHECK(std::abs(elastic(edge).force) < 1e-3 * 3);
  CHECK(elastic(2e-3).slope == doctest::Approx(k).epsilon(1e-3));
  CHECK(learner->law().damping(learner->state(), 2e-3) == doctest::Approx(30).epsilon(1e-3));
}

TEST_CASE("as long as a free tool has felt nothing the learner says that it is lost") {
  const auto learner = std::make_unique<TissueLearner<>>(settings());
  History<double> forces;
  for (int tick = 0; tick <= 64; ++tick) (void)forces.push(tick * 1ms, 1.0);
  learner->learn({0ms, 0, 0, 0}, forces);
  CHECK(!learner->lost());
  learner->learn({32ms, 5.12e-3, 0.32, 0}, forces);  // 1 N on 0.1 kg
  CHECK(learner->lost());
  learner->learn({64ms, 2e-2, 0.3, 5}, forces);
  CHECK(!learner->lost());
}

TEST_CASE("a tissue that pulls after all is learnt as one without an edge") {
  const auto learner = std::make_unique<TissueLearner<>>(settings());
  History<double> forces;
  for (int tick = 0; tick <= 64; ++tick) (void)forces.push(tick * 1ms, 0.0);
  learner->learn({0ms, 0, 0.2, 0}, forces);
  learner->learn({16ms, 3e-3, 0.2, 0}, forces);
  REQUIRE(learner->law().contact());
  learner->learn({32ms, 1e-3, -0.2, -1}, forces);
  learner->learn({48ms, -2e-3, -0.2, -2}, forces);
  CHECK(!learner->law().contact());
  CHECK(!learner->lost());
}
