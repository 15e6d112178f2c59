// SPDX-License-Identifier: MIT
#include <limpid/device/simulated_force_sensor.hpp>

#include <conformance/force_sensor_suite.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

using limpid::Duration;
using limpid::ForceSensor;
using limpid::SimulatedForceSensor;
using limpid::Status;
using limpid::Time;
using namespace std::chrono_literals;

static_assert(ForceSensor<SimulatedForceSensor<>>);
static_assert(ForceSensor<SimulatedForceSensor<float>>);

namespace {

using Vector = Eigen::Vector3d;
using Settings = SimulatedForceSensor<>::Settings;

}  // namespace

TEST_CASE_TEMPLATE("the simulated sensor is a force sensor", Scalar, float, double, long double) {
  using Force = Eigen::Matrix<Scalar, 3, 1>;
  for (const Duration delay : {0ms, 1ms, 15ms}) {
    SimulatedForceSensor<Scalar> sensor({.noise = Force::Constant(Scalar(0.1)), .delay = delay, .loss = 0.3});
    Time now{};
    bool comes = true;
    limpid::test::check_force_sensor(
        sensor,
        [&] {
          now += 1ms;
          if (comes) CHECK(sensor.advance(now, {1, 2, 3}) == Status::ok);
          return now;
        },
        [&] { comes = false; }, [&] { sensor.disconnect(); });
  }
}

TEST_CASE("without noise the true force of the frame's instant is seen, and between calls it is a straight line") {
  SimulatedForceSensor<> sensor;
  REQUIRE(sensor.advance(0ms, Vector(0, 0, 0)) == Status::ok);
  for (int k = 1; k <= 100; ++k) {
    const Time now = k * 10ms;
    REQUIRE(sensor.advance(now, Vector(k * 0.1, -k * 0.2, 3)) == Status::ok);
    const auto reading = sensor.read(now);
    const double seconds = limpid::in_seconds(reading.stamp);
    CHECK(reading.status == Status::ok);
    CHECK(std::abs(reading.force[0] - 10 * seconds) < 1e-13);  // roundings of 20 N
    CHECK(std::abs(reading.force[1] + 20 * seconds) < 1e-13);
  }
}

TEST_CASE("frames are 1 to 3 ms apart, evenly spread") {
  SimulatedForceSensor<> sensor;
  Time last{-1};
  double sum = 0;
  int frames = 0;
  Duration shortest = 1h, longest{};
  for (Time now{}; now <= 10s; now += 10us) {
    REQUIRE(sensor.advance(now, Vector::Zero()) == Status::ok);
    const Time stamp = sensor.read(now).stamp;
    if (stamp == last) continue;
    if (last >= 0ms) {
      shortest = std::min(shortest, stamp - last);
      longest = std::max(longest, stamp - last);
      sum += limpid::in_seconds(stamp - last);
      ++frames;
    }
    last = stamp;
  }
  CHECK(shortest >= 1ms);
  CHECK(shortest < 1010us);
  CHECK(longest <= 3ms);
  CHECK(longest > 2990us);
  CHECK(std::abs(sum / frames - 2e-3) < 5 * 2e-3 / std::sqrt(12.0 * 5000));  // five deviations of the mean
}

TEST_CASE("noise has the deviation that is asked for, and the response is shown") {
  Eigen::Matrix3d response;
  response << 1, 0.1, 0, -0.05, 0.9, 0, 0.85, 0, 1.1;
  SimulatedForceSensor<> sensor({.response = response, .noise = Vector(0.1, 0.2, 0), .shortest = 1ms, .longest = 1ms});
  constexpr int frames = 20'000;
  Vector sum = Vector::Zero(), square = Vector::Zero();
  const Vector expected = response * Vector(1, -2, 3);
  for (int k = 0; k < frames; ++k) {
    REQUIRE(sensor.advance(k * 1ms, Vector(1, -2, 3)) == Status::ok);
    const Vector error = sensor.read(k * 1ms).force - expected;
    sum += error;
    square += error.cwiseAbs2();
  }
  const double root = std::sqrt(frames);
  CHECK(std::abs(sum[0] / frames) < 5 * 0.1 / root);  // five deviations
  CHECK(std::abs(sum[1] / frames) < 5 * 0.2 / root);
  CHECK(std::sqrt(square[0] / frames) == doctest::Approx(0.1).epsilon(5 / root));  // a deviation is known to 1/sqrt(2n)
  CHECK(std::sqrt(square[1] / frames) == doctest::Approx(0.2).epsilon(5 / root));
  CHECK(square[2] < frames * 1e-28);
}

TEST_CASE("a frame is seen its delay later") {
  SimulatedForceSensor<> sensor({.shortest = 2ms, .longest = 2ms, .delay = 5ms});
  for (int k = 0; k <= 40; ++k) {
    const Time now = k * 1ms;
    REQUIRE(sensor.advance(now, Vector(k, 0, 0)) == Status::ok);
    const auto reading = sensor.read(now);
    CHECK(has(reading.status, Status::no_sample) == (k < 5));
    if (k >= 5) CHECK(reading.stamp == (k - 5) / 2 * 2ms);
    if (k >= 5) CHECK(reading.force[0] == (k - 5) / 2 * 2);
  }
}

TEST_CASE("as many frames are lost as is asked for, and with all of them nothing comes") {
  SimulatedForceSensor<> sensor({.shortest = 1ms, .longest = 1ms, .loss = 0.25, .longest_age = 1s});
  std::set<Time> seen;
  constexpr int frames = 10'000;
  for (int k = 0; k < frames; ++k) {
    REQUIRE(sensor.advance(k * 1ms, Vector::Zero()) == Status::ok);
    if (!has(sensor.read(k * 1ms).status, Status::no_sample)) seen.insert(sensor.read(k * 1ms).stamp);
  }
  CHECK(std::abs(static_cast<double>(seen.size()) - 0.75 * frames) < 5 * std::sqrt(frames * 0.25 * 0.75));
  SimulatedForceSensor<> mute({.loss = 1});
  for (int k = 0; k < 1000; ++k) REQUIRE(mute.advance(k * 1ms, Vector::Zero()) == Status::ok);
  CHECK(mute.read(1s).status == Status::no_sample);
}

TEST_CASE("a force beyond the range is clipped and said to be") {
  SimulatedForceSensor<> sensor({.range = Vector(10, 10, 50), .shortest = 1ms, .longest = 1ms});
  REQUIRE(sensor.advance(0ms, Vector(3, -12, 60)) == Status::ok);
  CHECK(sensor.read(0ms).force == Vector(3, -10, 50));
  CHECK(sensor.read(0ms).status == Status::overload);
  REQUIRE(sensor.advance(1ms, Vector(3, -10, 50)) == Status::ok);
  CHECK(sensor.read(1ms).status == Status::ok);
}

TEST_CASE("unplugged it keeps the last force, plugged in it goes on, and what was on its way is lost") {
  SimulatedForceSensor<> sensor({.shortest = 1ms, .longest = 1ms, .delay = 2ms});
  for (int k = 0; k <= 10; ++k) REQUIRE(sensor.advance(k * 1ms, Vector(k, 0, 0)) == Status::ok);
  CHECK(sensor.read(10ms).force[0] == 8);
  sensor.disconnect();
  for (int k = 11; k <= 40; ++k) REQUIRE(sensor.advance(k * 1ms, Vector(k, 0, 0)) == Status::ok);
  CHECK(sensor.read(40ms).force[0] == 8);
  CHECK(sensor.read(40ms).status == (Status::disconnected | Status::stale));
  sensor.reconnect();
  REQUIRE(sensor.advance(41ms, Vector(41, 0, 0)) == Status::ok);
  CHECK(sensor.read(41ms).force[0] == 8);
  CHECK(sensor.read(41ms).status == Status::stale);
  for (int k = 42; k <= 43; ++k) REQUIRE(sensor.advance(k * 1ms, Vector(k, 0, 0)) == Status::ok);
  CHECK(sensor.read(43ms).force[0] == 41);
  CHECK(sensor.read(43ms).status == Status::ok);
}

TEST_CASE("the same seed gives the same, another one does not") {
  const auto sum = [](std::uint64_t seed) {
    SimulatedForceSensor<> sensor({.noise = Vector(1, 1, 1), .seed = seed});
    double all = 0;
    for (int k = 0; k < 100; ++k) {
      (void)sensor.advance(k * 1ms, Vector::Zero());
      all += sensor.read(k * 1ms).force.sum();
    }
    return all;
  };
  CHECK(sum(7) == sum(7));
  CHECK(sum(7) != sum(8));
}

TEST_CASE("wrong input changes nothing, and a leap of an hour costs no more than its last frames") {
  SimulatedForceSensor<> sensor;
  REQUIRE(sensor.advance(1ms, Vector(1, 1, 1)) == Status::ok);
  CHECK(sensor.advance(1ms, Vector(2, 2, 2)) == Status::clock_backwards);
  CHECK(sensor.advance(0ms, Vector(2, 2, 2)) == Status::clock_backwards);
  CHECK(sensor.advance(9ms, Vector(std::nan(""), 2, 2)) == Status::not_finite);
  CHECK(sensor.read(1ms).force == Vector(1, 1, 1));
  CHECK(sensor.advance(1h, Vector(1, 1, 1)) == Status::ok);
  CHECK(sensor.read(1h).stamp > 1h - 4ms);
  CHECK(sensor.advance(Time::max(), Vector(1, 1, 1)) == Status::ok);
}

TEST_CASE("settings that cannot serve are refused by name") {
  const auto refused = [](const Settings& settings, const char* field) {
    try {
      const SimulatedForceSensor<> sensor(settings);
      FAIL("accepted");
    } catch (const std::invalid_argument& error) {
      CHECK(std::string(error.what()).find(std::string("SimulatedForceSensor: ") + field + ": expected") == 0);
    }
  };
  refused({.response = Eigen::Matrix3d::Constant(std::nan(""))}, "response");
  refused({.noise = Vector(-1, 0, 0)}, "noise");
  refused({.range = Vector(0, 1, 1)}, "range");
  refused({.shortest = 0ms}, "shortest");
  refused({.shortest = 4ms}, "longest");
  refused({.delay = 64ms}, "delay");
  refused({.delay = -1ms}, "delay");
  refused({.loss = 1.1}, "loss");
  refused({.delay = 20ms}, "longest_age");
}

TEST_CASE("advance and read do not allocate") {
  SimulatedForceSensor<> sensor({.noise = Vector(1, 1, 1), .delay = 4ms, .loss = 0.1});
  double sum = 0;
  limpid::test::check_no_allocation([&] {
    for (int k = 0; k < 100; ++k) {
      (void)sensor.advance(k * 1ms, Vector::Zero());
      sum += sensor.read(k * 1ms).force.sum();
    }
  });
  CHECK(std::isfinite(sum));
}
