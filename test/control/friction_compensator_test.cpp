// SPDX-License-Identifier: MIT
#include <limpid/control/friction_compensator.hpp>

#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <random>

using limpid::DesiredJoints;
using limpid::FrictionCompensator;
using limpid::Status;
using namespace std::chrono_literals;

namespace {

using One = Eigen::Matrix<double, 1, 1>;
using Ones = Eigen::Array<double, 1, 1>;
using Compensator = FrictionCompensator<1>;

Compensator::Settings known(double coulomb) {
  Compensator::Settings settings;
  settings.identifier.largest = Ones(0.5);
  settings.identifier.start = Ones(coulomb);
  settings.presliding = Ones(0.001);
  settings.share = 0.75;
  return settings;
}

DesiredJoints<1> at(double q, double qdot = 0) { return {One(q), One(qdot), One(0.0)}; }

}  // namespace

TEST_CASE("before the wanted motion there is no torque; along it, the share of the friction") {
  Compensator compensator(known(0.25));
  CHECK(compensator.update(at(3)).tau[0] == 0);
  CHECK(compensator.update(at(3.1)).tau[0] == 0.75 * 0.25);  // 1 - exp(-100) is 1
  CHECK(compensator.update(at(2.9)).tau[0] == -0.75 * 0.25);
}

TEST_CASE("after a reversal it turns over the presliding distance, whatever the ticks") {
  Compensator fine(known(0.25)), coarse(known(0.25));
  for (auto* each : {&fine, &coarse}) {
    (void)each->update(at(0));
    (void)each->update(at(1));
  }
  for (int k = 1; k <= 100; ++k) {
    const double back = 2e-5 * k, tau = fine.update(at(1 - back)).tau[0];
    // 100 steps of some roundings of 1 in q over z_s
    REQUIRE(tau == doctest::Approx(0.75 * 0.25 * (-1 + 2 * std::exp(-back / 0.001))).epsilon(1e-11));
  }
  CHECK(coarse.update(at(1 - 2e-3)).tau[0] == doctest::Approx(fine.update(at(1 - 2e-3)).tau[0]).epsilon(1e-11));
}

TEST_CASE("where the wanted motion rests, so does the torque, also while friction is identified from a jitter") {
  Compensator compensator(known(0.25));
  (void)compensator.update(at(0));
  const double tau = compensator.update(at(0.01)).tau[0];
  for (int k = 0; k < 1000; ++k) {
    CHECK(compensator.identify(k * 1ms, {One(1e-4 * (k % 2)), One(0.0)}, One(0.3)) == Status::ok);
    REQUIRE(compensator.update(at(0.01)).tau[0] == tau);
  }
}

TEST_CASE("the torque never leaves its bound, whatever is wanted and identified") {
  auto settings = known(0.5);
  settings.identifier.largest_viscous = Ones(2);
  Compensator compensator(settings);
  std::mt19937 random(16);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int k = 0; k < 10'000; ++k) {
    (void)compensator.identify(k * 1ms, {One(any(random)), One(9 * any(random))}, One(1e3 * any(random)));
    REQUIRE(std::abs(compensator.update(at(any(random), 1e6 * any(random))).tau[0]) <= 0.5);
  }
}

TEST_CASE("identified viscous friction is compensated by its share of the wanted rate") {
  auto settings = known(0);
  settings.identifier.largest_viscous = Ones(0.2);
  Compensator compensator(settings);
  for (int k = 0; k < 2000; ++k) (void)compensator.identify(k * 1ms, {One(1e-3 * k), One(1.0)}, One(10.0));
  CHECK(compensator.friction().viscous[0] == 0.2);
  CHECK(compensator.friction().coulomb[0] == 0.5);
  (void)compensator.update(at(0));
  CHECK(compensator.update(at(0, 0.5)).tau[0] == doctest::Approx(0.75 * 0.2 * 0.5).epsilon(1e-15));
}

TEST_CASE("a wanted motion that is not finite, or out of range, changes nothing") {
  constexpr double infinity = std::numeric_limits<double>::infinity(), largest = std::numeric_limits<double>::max();
  Compensator compensator(known(0.25)), twin(known(0.25));
  for (int k = 0; k < 20; ++k) {
    const double q = 4e-4 * std::sin(k), tau = compensator.update(at(q)).tau[0];
    CHECK(tau == twin.update(at(q)).tau[0]);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
      for (const auto& wanted : {at(bad), at(q, bad)}) {
        const auto [kept, status] = compensator.update(wanted);
        CHECK(kept[0] == tau);
        CHECK(status == Status::not_finite);
      }
    }
    CHECK(compensator.update(at(largest)).status == Status::not_finite);  // over z_s
  }
}

TEST_CASE("no call allocates") {
  FrictionCompensator<3> compensator({.identifier = {.largest = {0.1, 0.1, 0.1}}});
  limpid::test::check_no_allocation([&] {
    for (int k = 0; k < 100; ++k) {
      (void)compensator.identify(k * 1ms, {{0.01 * k, 0, 0}, {10, 0, 0}}, {0.1, 0.2, 0.3});
      (void)compensator.update({{0.01 * k, 0, 0}, {10, 0, 0}, {0, 0, 0}});
    }
  });
}

TEST_CASE("settings that cannot serve are refused by name, all of the friction among them") {
  const auto refused = [](auto change, const char* message) {
    auto settings = known(0.1);
    change(settings);
    CHECK_THROWS_WITH_AS(Compensator{settings}, message, std::invalid_argument);
  };
  refused([](auto& s) { s.share = 1; }, "FrictionCompensator: share: expected of [0, 1), got 1");
  refused([](auto& s) { s.share = -0.1; }, "FrictionCompensator: share: expected of [0, 1), got -0.1");
  refused([](auto& s) { s.presliding[0] = 0; }, "FrictionCompensator: presliding: expected finite and > 0, got 0");
  refused([](auto& s) { s.identifier.largest[0] = 0; }, "FrictionIdentifier: largest: expected finite and > 0, got 0");
}
