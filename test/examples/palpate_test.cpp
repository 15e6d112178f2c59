// SPDX-License-Identifier: MIT
#include "common/scene.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>

using namespace limpid;
using namespace limpid::examples;

namespace {

Scene press_on(double stiffness, double period, PredictorGain gain) {
  Scene scene;
  scene.tissue.stiffness = stiffness;
  scene.gain = std::move(gain);
  scene.force = press_like_force();
  scene.duration = scene.force.duration;
  scene.period = scene.delay = from_seconds(period);
  return scene;
}

double prediction_ratio(const Scene& scene) {
  const double model = palpate(scene, PredictorKind::model).prediction.total().l2;
  return model / palpate(scene, PredictorKind::hold).prediction.total().l2;
}

}  // namespace

TEST_CASE("prediction is exact where the tissue is linear and known") {
  Scene scene = press_on(800, 0.1, {-195.1, -4.89});
  scene.estimation.known = true;
  CHECK(prediction_ratio(scene) < 1e-11);  // rounding: 2e4 steps of some 1e-16
}

TEST_CASE("with an estimated linear tissue the prediction error is a small part of hold's") {
  CHECK(prediction_ratio(press_on(800, 0.1, {-195.1, -4.89})) < 0.1);  // issue's bound for recordings
}

TEST_CASE("a known nonlinear tissue is predicted to the second order of the tick") {
  Scene scene = press_on(370, 0.1, {0, 0});
  scene.tissue.kind = TissueKind::smooth_bilinear;
  scene.tissue.stiffness2 = 1980;
  scene.estimation.known = true;
  const double coarse = palpate(scene, PredictorKind::model).prediction.total().l2;
  scene.tick /= 2;
  const double fine = palpate(scene, PredictorKind::model).prediction.total().l2;
  CHECK(coarse / fine > 3);  // a local error of dt^3 adds up to dt^2: 4 in the limit; first order would give 2
}

TEST_CASE("tracking the ideal signal is at least as good as tracking the held one") {
  const Scene scene = press_on(800, 0.1, {0, 0});
  CHECK(palpate(scene, PredictorKind::ideal).total.total().l2 < palpate(scene, PredictorKind::hold).total.total().l2);
}

TEST_CASE("the realistic arm follows with its torque limits, friction and encoders, and without a fault") {
  Scene scene = press_on(800, 0.1, {-195.1, -4.89});
  scene.robot = RobotKind::realistic;
  for (const bool playback : {false, true}) {
    CAPTURE(playback);
    scene.playback = playback;
    const PalpationResult result = palpate(scene, PredictorKind::model);
    CHECK_FALSE(has(result.status, Status::fault | Status::not_finite));
    for (const TracePoint& point : result.trace) {
      REQUIRE(point.torque.cwiseAbs()[0] <= 0.30 / 1.3);  // Table 5.1 over the safety factor
      REQUIRE(point.torque.cwiseAbs()[1] <= 0.29 / 1.3);
      REQUIRE(point.torque.cwiseAbs()[2] <= 0.20 / 1.3);
    }
  }
}

TEST_CASE("with unilateral contact the tool leaves the wall and never feels it pull") {
  Scene scene = press_on(800, 0.1, {0, 0});
  scene.force = sine_force(1, 0.5, std::chrono::seconds{4});
  scene.duration = scene.force.duration;
  scene.tissue.unilateral = true;
  double outermost = 0;
  for (const TracePoint& point : palpate(scene, PredictorKind::model).trace)
    outermost = std::min(outermost, point.ideal);
  CHECK(outermost < -0.1);  // 1 N on 0.1 kg, for a second and without a spring: metres
}

TEST_CASE("a firm recorded press on a medium tissue is predicted with a fiftieth of hold's error") {
  const char* folder = std::getenv("LIMPID_RECORDINGS");
  const std::filesystem::path file =
      std::filesystem::path(folder == nullptr ? "" : folder) / "press_1cm_47ohms_unstretched.csv";
  if (!std::filesystem::exists(file)) {
    MESSAGE("skipped: LIMPID_RECORDINGS has no " << file.filename().string());
    return;
  }
  Scene scene = press_on(800, 0.1, {-195.1, -4.89});
  scene.force = recorded_force(file.string(), 0.05);
  scene.duration = scene.force.duration;
  CHECK(prediction_ratio(scene) <= 0.02);
}

TEST_CASE("every recording, tissue and period of Table 6.4 is predicted with a tenth of hold's error") {
  const char* folder = std::getenv("LIMPID_RECORDINGS");
  if (folder == nullptr || !std::filesystem::is_directory(folder)) {
    MESSAGE("skipped: LIMPID_RECORDINGS names no folder of recordings");
    return;
  }
  const std::pair<double, PredictorGain> settings[] = {
      {0.016, {-441.3, -12.12}}, {0.032, {-203.3, -5.15}}, {0.1, {-195.1, -4.89}}};
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".csv") continue;
    CAPTURE(file.path().filename().string());
    const PressForce force = recorded_force(file.path().string(), 0.05);
    for (const double stiffness : {200.0, 800.0, 1500.0}) {
      for (const auto& setting : settings) {
        const double period = setting.first;
        CAPTURE(stiffness);
        CAPTURE(period);
        Scene scene = press_on(stiffness, period, setting.second);
        scene.force = force;
        scene.duration = force.duration;
        CHECK(prediction_ratio(scene) <= 0.1);
      }
    }
  }
}
