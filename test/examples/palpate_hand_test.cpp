// SPDX-License-Identifier: MIT
#include <support/maximum.hpp>
#include "common/scene.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

using namespace limpid;
using namespace limpid::examples;
using limpid::test::maximum;

namespace {

constexpr double strongest = 3;  // N

// The program's own scene, shorter: a press of 3 N and a rest.
Scene short_press(const HandModel& hand) {
  Scene scene;
  scene.hand = hand;
  scene.gain = {0, 0};
  scene.estimation.known = true;
  scene.force = raised_cosine_force(strongest, 0.5, std::chrono::seconds{4});
  scene.duration = scene.force.duration;
  scene.period = scene.delay = std::chrono::milliseconds{100};
  return scene;
}

double peak_force(const PalpationResult& result) {
  double peak = 0;
  for (const TracePoint& point : result.trace) peak = maximum(peak, std::abs(point.force));
  return peak;
}

template <typename Visit>
void for_hands(Visit&& visit) {
  for (const double M : {0.02, 0.3, 1.0}) {
    for (const double B : {0.5, 5.0, 20.0}) {
      for (const double K : {50.0, 300.0, 1000.0}) {
        CAPTURE(M);
        CAPTURE(B);
        CAPTURE(K);
        visit(HandModel{M, B, K});
      }
    }
  }
}

void check_sound(const PalpationResult& result) {
  CHECK_FALSE(has(result.status, Status::fault | Status::not_finite | Status::unreachable));
  const HandEnergy<>& energy = result.energy;
  const double exchanged = energy.kinetic + energy.elastic + energy.dissipated + std::abs(energy.work);
  // four Gauss points at h |lambda| <= 1 leave 1e-7 of a power, and far less at most ticks
  CHECK(std::abs(energy.residual()) <= 1e-6 * exchanged);
  CHECK(energy.delivered <= energy.initial + energy.work + 1e-6 * exchanged);
}

}  // namespace

// A hand against a tip that stands overshoots a step of its intention by no more than the step's height; this press,
// slower than all of these hands, asks for far less.
TEST_CASE("a hand, heavy or light, presses a stable tool where the tool is the true one, known or estimated") {
  for_hands([](const HandModel& hand) {
    Scene scene = short_press(hand);
    const auto check = [&](PredictorKind predictor) {
      const PalpationResult result = palpate(scene, predictor);
      CHECK(peak_force(result) <= 2 * strongest);
      check_sound(result);
    };
    check(PredictorKind::ideal);
    check(PredictorKind::model);
    scene.estimation.known = false;
    check(PredictorKind::model);
  });
}

TEST_CASE("a realistic arm, with its friction, limits and encoders, is as stable in the hand") {
  for_hands([](const HandModel& hand) {
    Scene scene = short_press(hand);
    scene.robot = RobotKind::realistic;
    const PalpationResult result = palpate(scene, PredictorKind::model);
    CHECK(peak_force(result) <= 2 * strongest);
    check_sound(result);
  });
}

TEST_CASE("where the late sample is held, a heavy and stiff hand swings up, and takes the energy from the device") {
  // 0.2 s late, the tissue of 800 N/m turns against a hand whose M omega^2 is as large before its grip lets go
  Scene scene = short_press({1, 0.5, 1000});
  const PalpationResult held = palpate(scene, PredictorKind::hold);
  CHECK(peak_force(held) > 2 * strongest);
  CHECK(held.energy.delivered < 0);
  CHECK(std::abs(held.energy.residual()) < 1e-6 * (held.energy.dissipated + held.energy.elastic));
  scene.hand = HandModel{0.1, 5, 300};  // a light one does not
  const PalpationResult light = palpate(scene, PredictorKind::hold);
  CHECK(peak_force(light) <= 2 * strongest);
  check_sound(light);
}

TEST_CASE("at the end of the run the hand gives what is intended") {
  Scene scene = short_press({0.1, 5, 300});
  scene.force = {[](Time t) { return std::min(2.0, 2 * in_seconds(t)); }, std::chrono::seconds{4}, "ramp to 2 N"};
  const PalpationResult result = palpate(scene, PredictorKind::model);
  CHECK(std::abs(result.trace.back().force - 2) < 1e-3);  // the arm's last motions, felt through B
}

TEST_CASE("without a hand the force is the scene's and no energy is counted") {
  Scene scene = short_press({});
  scene.hand.reset();
  const PalpationResult result = palpate(scene, PredictorKind::model);
  for (const TracePoint& point : result.trace) REQUIRE(point.force == point.intention);
  CHECK(result.energy.work == 0);
  CHECK(result.energy.delivered == 0);
}

TEST_CASE("a hand holds the arm, which playback leaves alone: both are refused") {
  Scene scene = short_press({0.1, 5, 300});
  scene.playback = true;
  CHECK_THROWS_AS((void)palpate(scene, PredictorKind::model), std::invalid_argument);
}
