// SPDX-License-Identifier: MIT
// What each disturbance does to the tissue and to what is seen of it.
#include "common/scene.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace limpid;
using namespace limpid::examples;

namespace {

Scene press(double seconds, double period) {
  Scene scene;
  scene.force = press_like_force();
  scene.duration = from_seconds(seconds);
  scene.period = scene.delay = from_seconds(period);
  return scene;
}

// Of 2 N from the start on.
Scene push(double seconds) {
  Scene scene = press(seconds, 0.1);
  scene.force = {[](Time) { return 2.0; }, scene.duration, "2 N"};
  return scene;
}

std::vector<TracePoint> held(const Scene& scene) { return palpate(scene, PredictorKind::hold).trace; }

double last_depth(const Scene& scene) { return held(scene).back().ideal; }

bool same(const std::vector<TracePoint>& left, const std::vector<TracePoint>& right) {
  return std::equal(left.begin(), left.end(), right.begin(), right.end(), [](const auto& l, const auto& r) {
    return l.ideal == r.ideal && l.predicted == r.predicted && l.tip == r.tip && l.torque == r.torque;
  });
}

// Ticks at which what is held changes.
std::vector<std::size_t> arrivals(const std::vector<TracePoint>& trace) {
  std::vector<std::size_t> ticks;
  for (std::size_t k = 1; k < trace.size(); ++k) {
    if (trace[k].predicted != trace[k - 1].predicted) ticks.push_back(k);
  }
  return ticks;
}

}  // namespace

TEST_CASE("disturbances of size zero change no bit") {
  Scene scene = press(1.5, 0.1);
  const auto clean = held(scene);
  scene.disturbances = {.tissue = {.lag = 0.3}, .step_at = 0.5, .sensing = {}, .seed = 7};
  CHECK(same(held(scene), clean));
}

TEST_CASE("a tissue whose step is too small to be seen moves as the undisturbed one") {
  for (const TissueKind kind : {TissueKind::kelvin_voigt, TissueKind::smooth_bilinear, TissueKind::hunt_crossley,
                                TissueKind::exponential, TissueKind::layered}) {
    CAPTURE(std::string(name(kind)));
    Scene scene = press(2, 0.1);
    scene.tissue.kind = kind;
    const auto clean = held(scene);
    scene.disturbances.tissue.step = 1 + 1e-15;
    const auto stepped = held(scene);
    double miss = 0;
    for (std::size_t k = 0; k < clean.size(); ++k) miss = std::max(miss, std::abs(stepped[k].ideal - clean[k].ideal));
    CHECK(miss < 1e-9);  // m; a kink within a Runge-Kutta step of 50 us at 20 mm/s: 1 um in a force of third order
  }
}

TEST_CASE("the same seed draws the same, another one does not") {
  Scene scene = press(1.5, 0.032);
  scene.disturbances.sensing = {.position_noise = 1e-5, .jitter = 0.2, .loss = 0.1};
  const auto first = held(scene);
  CHECK(same(held(scene), first));
  scene.disturbances.seed = 2;
  CHECK_FALSE(same(held(scene), first));
}

TEST_CASE("a quantised depth is the nearest multiple of its step") {
  Scene scene = press(1.5, 0.1);
  const auto clean = held(scene);
  scene.disturbances.sensing.position_step = 1e-5;
  const auto quantised = held(scene);
  for (std::size_t k = 0; k < clean.size(); ++k) {
    REQUIRE(quantised[k].ideal == clean[k].ideal);
    REQUIRE(quantised[k].predicted == std::round(clean[k].predicted / 1e-5) * 1e-5);
  }
}

TEST_CASE("a noisy force does nothing to hold, and something to who uses the force") {
  Scene scene = press(1.5, 0.1);
  const auto clean = held(scene), extrapolated = palpate(scene, PredictorKind::quadratic).trace;
  scene.disturbances.sensing.force_noise = 0.03;
  CHECK(same(held(scene), clean));
  CHECK_FALSE(same(palpate(scene, PredictorKind::quadratic).trace, extrapolated));
}

TEST_CASE("noise has the deviation asked for") {
  Scene scene = press(10, 0.01);
  const auto clean = held(scene);
  scene.disturbances.sensing.position_noise = 1e-4;
  const auto noisy = held(scene);
  double sum = 0;
  for (std::size_t k = 0; k < clean.size(); ++k) {
    REQUIRE(noisy[k].ideal == clean[k].ideal);
    sum += std::pow((noisy[k].predicted - clean[k].predicted) / 1e-4, 2);
  }
  // The mean square of 1000 samples deviates by sqrt(2/1000) of itself: five of that.
  CHECK(sum / static_cast<double>(clean.size()) == doctest::Approx(1).epsilon(5 * std::sqrt(2.0 / 1000)));
}

TEST_CASE("as many samples are lost as asked for") {
  Scene scene = press(10, 0.01);
  scene.disturbances.sensing.position_noise = 1e-6;  // so that each one differs
  const auto all = static_cast<double>(arrivals(held(scene)).size());
  CHECK(all == 1000);
  scene.disturbances.sensing.loss = 0.25;
  const auto left = static_cast<double>(arrivals(held(scene)).size());
  CHECK(std::abs(left - 750) < 5 * std::sqrt(1000 * 0.25 * 0.75));
}

TEST_CASE("samples are late or early by at most the jitter, and in their order") {
  Scene scene = press(5, 0.1);
  scene.disturbances.sensing = {.position_noise = 1e-6, .jitter = 0.2};
  const auto ticks = arrivals(held(scene));
  CHECK(ticks.size() >= 49);  // of 50, the last of which may be late
  double furthest = 0;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    furthest = std::max(furthest, std::abs(static_cast<double>(ticks[i]) - 100.0 * static_cast<double>(i + 1)));
  }
  CHECK(furthest <= 20.5);
  CHECK(furthest > 15);  // of 49 drawn evenly from 0 to 20, but for a chance of (3/4)^49 = 8e-7
}

TEST_CASE("under a constant force a tissue gives way until its spring holds the tool") {
  Scene scene = push(3);
  CHECK(last_depth(scene) == doctest::Approx(2.0 / 800).epsilon(1e-9));  // 3 s are 80 of B/k
  scene.disturbances = {.tissue = {.step = 1.3}, .step_at = 1, .sensing = {}};
  CHECK(last_depth(scene) == doctest::Approx(2.0 / 800 / 1.3).epsilon(1e-9));
  scene.disturbances = {.tissue = {.relaxation = 200, .lag = 0.1}, .sensing = {}};
  CHECK(last_depth(scene) == doctest::Approx(2.0 / 800).epsilon(1e-6));  // relaxed at 6.2 1/s: exp(-18)
  scene.disturbances = {};
  scene.tissue.wall = 0.001;
  CHECK(last_depth(scene) == doctest::Approx(0.001 + 2.0 / 800).epsilon(1e-9));
  scene.disturbances.tissue.step = 1.3;
  CHECK(last_depth(scene) == doctest::Approx(0.001 + 2.0 / 800 / 1.3).epsilon(1e-9));
}

TEST_CASE("a Maxwell branch adds its stiffness at first") {
  Scene scene = push(0.3);
  scene.disturbances.tissue = {.relaxation = 400, .lag = 100};
  CHECK(last_depth(scene) == doctest::Approx(2.0 / 1200).epsilon(0.003));  // relaxed by .3 s of 100 s
}

TEST_CASE("a tissue that softens is followed by what its damper leaves behind") {
  Scene scene = push(4);
  scene.disturbances.tissue.softening = 0.1;
  // (b + b_t) x' + k(t) x = F with k = 800 (1 - t/10): x = F/k - (b + b_t)/k (F/k)' + ..., each term 1 % of the last
  const double k = 800 * 0.6, rest = 2 / k, rate = 2 * 80 / (k * k);
  CHECK(last_depth(scene) == doctest::Approx(rest - 30.1 / k * rate).epsilon(5e-4));
}

TEST_CASE("damping that grows with depth delays the press as its integral says") {
  Scene scene = push(1);
  scene.disturbances.tissue.damping_growth = 1e5;
  // (B + c x) x' = F - k x, without the mass, whose m/B of 3 ms delays the start: t(x) in closed form.
  const double B = 30.1, k = 800, c = 1e5, F = 2, u = 0.9, away = -std::log(1 - u);
  const double expected = B / k * away + c * F / (k * k) * (away - u);
  const auto trace = held(scene);
  const auto there =
      std::find_if(trace.begin(), trace.end(), [&](const TracePoint& point) { return point.ideal >= u * F / k; });
  REQUIRE(there != trace.end());
  CHECK(std::abs(there->time - expected) < 0.005);
}

TEST_CASE("dry friction holds the tool against less than itself") {
  Scene scene = push(1);
  scene.disturbances.tissue.friction = 2.01;
  CHECK(last_depth(scene) == 0);
  scene.disturbances.tissue.friction = 0.5;
  const double depth = last_depth(scene);
  CHECK(depth > 1.5 / 800 - 1e-9);  // it comes to rest from above, where the spring has 1.5 N
  CHECK(depth < 1.5 / 800 + 1e-4);
}

TEST_CASE("the exponential and the layered tissue give way to where their laws say") {
  Scene scene = push(3);
  scene.tissue.kind = TissueKind::exponential;
  CHECK(last_depth(scene) == doctest::Approx(std::log(1 + 2 / 0.5) / 600).epsilon(1e-9));
  scene.tissue.kind = TissueKind::layered;  // .6 N in the first layer, 1.4 N in the second
  CHECK(last_depth(scene) == doctest::Approx(0.0015 + 1.4 / 1500).epsilon(1e-9));
}

TEST_CASE("a tissue that is disturbed is refused where the tool's spring pulls to the base") {
  Scene scene = press(1, 0.1);
  scene.spring_at_base = true;
  scene.disturbances.sensing.loss = 0.1;
  CHECK_THROWS_AS((void)palpate(scene, PredictorKind::hold), std::invalid_argument);
}
