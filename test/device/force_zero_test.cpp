// SPDX-License-Identifier: MIT
#include <limpid/device/force_zero.hpp>

#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <limits>
#include <stdexcept>

using limpid::ForceReading;
using limpid::ForceZero;
using limpid::Status;
using State = limpid::ForceZero<>::State;
using namespace std::chrono_literals;

namespace {

ForceReading<> reading(int milliseconds, const Eigen::Vector3d& force, Status status = Status::ok) {
  return {force, milliseconds * 1ms, status};
}

}  // namespace

TEST_CASE("before it is started nothing is taken off") {
  ForceZero<> zero;
  CHECK(zero.state() == State::none);
  CHECK(zero.update(reading(1, {1, 2, 3})).force == Eigen::Vector3d(1, 2, 3));
}

TEST_CASE("the mean of the readings is taken off each one from then on") {
  ForceZero<> zero({.samples = 4});
  zero.start();
  for (int k = 1; k <= 4; ++k) {
    CHECK(zero.state() == State::averaging);
    const double wobble = k % 2 == 0 ? 0.0625 : -0.0625;
    const auto answer = zero.update(reading(k, {0.5 + wobble, -1 - wobble, 2}));
    if (k < 4) CHECK(answer.force == Eigen::Vector3d(0.5 + wobble, -1 - wobble, 2));
    CHECK(answer.stamp == k * 1ms);
  }
  CHECK(zero.state() == State::zeroed);
  CHECK((zero.zero() - Eigen::Vector3d(0.5, -1, 2)).norm() < 1e-15);
  CHECK((zero.update(reading(5, {1.5, 0, 2})).force - Eigen::Vector3d(1, 1, 0)).norm() < 1e-15);
}

TEST_CASE("only new readings that are well count") {
  ForceZero<> zero({.samples = 2});
  zero.start();
  (void)zero.update(reading(1, {0.1, 0, 0}));
  (void)zero.update(reading(1, {0.1, 0, 0}));  // the same one
  for (const Status status : {Status::stale, Status::disconnected, Status::fault, Status::overload}) {
    (void)zero.update(reading(2, {50, 0, 0}, status));
  }
  (void)zero.update(reading(3, {std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  CHECK(zero.state() == State::averaging);
  (void)zero.update(reading(4, {0.2, 0, 0}));
  CHECK(zero.state() == State::zeroed);
  CHECK(zero.zero()[0] == doctest::Approx(0.15).epsilon(1e-15));
}

TEST_CASE("where somebody moves the sensor the zero before is kept") {
  ForceZero<> zero({.samples = 3, .largest_spread = 0.5});
  zero.start();
  for (int k = 1; k <= 3; ++k) (void)zero.update(reading(k, {1, 1, 1}));
  zero.start();
  (void)zero.update(reading(4, {2, 2, 2}));
  const auto held = zero.update(reading(5, {2, 2, 1.4}));
  CHECK(zero.state() == State::unsteady);
  CHECK(held.force == Eigen::Vector3d(1, 1, 1.4 - 1));
  (void)zero.update(reading(6, {2, 2, 2}));
  CHECK(zero.zero() == Eigen::Vector3d(1, 1, 1));
  zero.start();
  for (int k = 7; k <= 9; ++k) (void)zero.update(reading(k, {2, 2, 2}));
  CHECK(zero.zero() == Eigen::Vector3d(2, 2, 2));
}

TEST_CASE("a sensor that has felt nothing stays at zero") {
  ForceZero<> zero({.samples = 1});
  zero.start();
  (void)zero.update(reading(1, {3, 0, 0}));
  CHECK(zero.update(reading(0, {0, 0, 0}, Status::no_sample)).force == Eigen::Vector3d(0, 0, 0));
}

TEST_CASE("settings that cannot serve are refused by name, and update does not allocate") {
  CHECK_THROWS_WITH_AS(ForceZero<>({.samples = 0}), "ForceZero: samples: expected > 0, got 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(ForceZero<>({.largest_spread = 0}), "ForceZero: largest_spread: expected finite and > 0, got 0",
                       std::invalid_argument);
  ForceZero<> zero({.samples = 5});
  limpid::test::check_no_allocation([&] {
    zero.start();
    for (int k = 1; k <= 10; ++k) (void)zero.update(reading(k, {1, 1, 1}));
  });
}
