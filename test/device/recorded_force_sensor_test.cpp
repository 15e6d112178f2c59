// SPDX-License-Identifier: MIT
#include <limpid/device/recorded_force_sensor.hpp>

#include <conformance/force_sensor_suite.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <limits>
#include <sstream>
#include <stdexcept>

using limpid::ForceSensor;
using limpid::RecordedForceSensor;
using limpid::Recording;
using limpid::Status;
using limpid::Time;
using namespace std::chrono_literals;

static_assert(ForceSensor<RecordedForceSensor<>>);
static_assert(ForceSensor<RecordedForceSensor<float>>);

namespace {

using Vector = Eigen::Vector3d;

Recording recording() {
  std::istringstream text("0,1\n0.1,3\n0.2,5\n");
  return Recording::parse(text, "press.csv");
}

}  // namespace

TEST_CASE_TEMPLATE("a recording is a force sensor", Scalar, float, double) {
  RecordedForceSensor<Scalar> sensor(recording(), {.start = 3ms});
  Time now{};
  limpid::test::check_force_sensor(
      sensor, [&] { return now += 1ms; }, [] {});
}

TEST_CASE("it plays the recording along its direction from its start") {
  RecordedForceSensor<> sensor(recording(), {.direction = Vector(0.5, 0, -2), .start = 1s});
  CHECK(sensor.read(999ms).status == Status::no_sample);
  CHECK(sensor.read(999ms).force == Vector(0, 0, 0));
  CHECK(sensor.read(1s).force == Vector(0.5, 0, -2));
  CHECK((sensor.read(1100ms).force - Vector(1.5, 0, -6)).norm() < 1e-15);
  CHECK(sensor.read(1100ms).stamp == 1100ms);
  CHECK(sensor.read(1100ms).status == Status::ok);
}

TEST_CASE("after its end the last force is held, and stale when it is too old") {
  RecordedForceSensor<> sensor(recording(), {.longest_age = 50ms});
  CHECK(sensor.read(250ms).status == Status::ok);
  CHECK(sensor.read(250ms).stamp == 200ms);
  CHECK(sensor.read(251ms).status == Status::stale);
  CHECK(sensor.read(251ms).force == Vector(0, 0, 5));
}

TEST_CASE("where time goes back the newest reading is kept") {
  RecordedForceSensor<> sensor(recording());
  CHECK(sensor.read(100ms).force[2] == 3);
  CHECK(sensor.read(20ms).stamp == 100ms);
  CHECK(sensor.read(-20ms).force[2] == 3);
}

TEST_CASE("a force too large for the direction is not taken over") {
  RecordedForceSensor<> sensor(recording(), {.direction = Vector(0, 0, std::numeric_limits<double>::max() / 2)});
  CHECK(sensor.read(0ms).status == Status::ok);
  CHECK(sensor.read(200ms).status == Status::not_finite);
  CHECK(sensor.read(200ms).force[2] == std::numeric_limits<double>::max() / 2);
}

TEST_CASE("settings that cannot serve are refused, and reading does not allocate") {
  CHECK_THROWS_AS(
      RecordedForceSensor<>(recording(), {.direction = Vector::Constant(std::numeric_limits<double>::quiet_NaN())}),
      std::invalid_argument);
  CHECK_THROWS_AS(RecordedForceSensor<>(recording(), {.longest_age = -1ms}), std::invalid_argument);
  RecordedForceSensor<> sensor(recording());
  limpid::test::check_no_allocation([&] { (void)sensor.read(5ms); });
}
