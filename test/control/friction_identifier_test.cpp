// SPDX-License-Identifier: MIT
#include <limpid/control/friction_identifier.hpp>

#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <random>

using limpid::FrictionIdentifier;
using limpid::in_seconds;
using limpid::Status;
using limpid::Time;
using limpid::turned;
using namespace std::chrono_literals;

namespace {

using One = Eigen::Matrix<double, 1, 1>;
using Ones = Eigen::Array<double, 1, 1>;
using Identifier = FrictionIdentifier<1>;

Identifier::Settings up_to(double largest, double viscous = 0) {
  Identifier::Settings settings;
  settings.largest = Ones(largest);
  settings.largest_viscous = Ones(viscous);
  return settings;
}

// A joint that swings 0.2 rad to either side at up to 0.8 rad/s, with the torque of an observer that knows all of its
// motion: f_c z + f_v q' behind W.
class Swing {
 public:
  explicit Swing(double f_c, double f_v = 0) : coulomb{f_c}, viscous{f_v} {}

  double coulomb, viscous;

  // Moves on by `seconds`, by 1 ms each.
  Status run(Identifier& identifier, double seconds) {
    Status status = Status::ok;
    for (const Time end = now_ + limpid::from_seconds(seconds); now_ < end; now_ += 1ms) {
      const double t = in_seconds(now_), q = 0.2 * std::sin(4 * t), qdot = 0.8 * std::cos(4 * t);
      z_ = turned(z_, (q - q_) / 5e-4);
      q_ = q;
      double input = coulomb * z_ + viscous * qdot;
      for (double& lag : lag_) input = lag += (1 - std::exp(-0.1)) * (input - lag);  // w = 100 rad/s
      status |= identifier.update(now_, {One(q), One(qdot)}, Ones(input));
    }
    return status;
  }

 private:
  Time now_{};
  double q_ = 0, z_ = 0;
  double lag_[3] = {0, 0, 0};
};

}  // namespace

TEST_CASE("Dahl's sign stays within 1, turns over its distance, and takes a path in pieces as in one") {
  CHECK(turned(1.0, -2.0) == doctest::Approx(-1 + 2 * std::exp(-2)).epsilon(1e-15));  // dz = dx - |dx| z, solved
  CHECK(turned(0.0, 3.0) == doctest::Approx(1 - std::exp(-3)).epsilon(1e-15));
  CHECK(turned(0.25, 0.0) == 0.25);
  CHECK(turned(-1.0, 1e300) == 1);
  std::mt19937 random(1968);
  std::uniform_real_distribution<double> any(-4, 4);
  double z = 0;
  for (int i = 0; i < 10'000; ++i) {
    const double path = any(random), half = turned(z, path / 2);
    CAPTURE(path);
    REQUIRE(std::abs(turned(half, path / 2) - turned(z, path)) <= 4 * std::numeric_limits<double>::epsilon());
    z = turned(z, path);
    REQUIRE(std::abs(z) <= 1);
  }
}

TEST_CASE("Coulomb and viscous friction of a swinging joint are found") {
  auto settings = up_to(0.1, 0.2);
  settings.encoder_step = Ones(0);  // so that both see the same path
  Identifier identifier(settings);
  Swing joint(0.065, 0.03);
  CHECK(joint.run(identifier, 10) == Status::ok);
  // the start, zero, counts for 2e-3 of some 1 rad that is remembered; viscous friction, largest_viscous q'_rms = .11
  // against .1 N m, as much
  CHECK(identifier.friction().coulomb[0] == doctest::Approx(0.065).epsilon(0.01));
  CHECK(identifier.friction().viscous[0] == doctest::Approx(0.03).epsilon(0.02));
}

TEST_CASE("behind an encoder's band Coulomb friction is found within a twentieth") {
  Identifier identifier(up_to(0.1));
  Swing joint(0.065);
  (void)joint.run(identifier, 10);
  // a reversal is seen a step of 4e-4 rad late, of the .4 rad of a stroke: some 1e-3; the rest is margin
  CHECK(identifier.friction().coulomb[0] == doctest::Approx(0.065).epsilon(0.05));
}

TEST_CASE("what was learnt is forgotten by the way that the joint has moved, to 1/e in `memory`") {
  auto settings = up_to(0.1);
  settings.memory = 2;
  settings.encoder_step = Ones(0);
  Identifier identifier(settings);
  Swing joint(0.08);
  (void)joint.run(identifier, 60);  // some 30 rad
  joint.coulomb = 0.04;
  const double pi = std::acos(-1.0);
  (void)joint.run(identifier, 5 * pi / 2);  // five periods of .8 rad: 4 rad, twice the memory
  const double expected = 0.04 + 0.04 * std::exp(-2);
  CHECK(identifier.friction().coulomb[0] == doctest::Approx(expected).epsilon(0.03));  // the torque's lag: .02 rad
}

TEST_CASE("a joint at rest, or one whose reading jitters within an encoder step, teaches nothing and forgets nothing") {
  Identifier identifier(up_to(0.1));
  Swing joint(0.065);
  (void)joint.run(identifier, 10);
  const double found = identifier.friction().coulomb[0];
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-2e-4, 2e-4), any(-0.1, 0.1);
  const double middle = 0.2 * std::sin(39.996);
  (void)identifier.update(10s, {One(middle + 2e-4), One(0.0)}, Ones(0.0));
  (void)identifier.update(10s + 1ms, {One(middle - 2e-4), One(0.0)}, Ones(0.0));  // where the band is now known
  const double settled = identifier.friction().coulomb[0];
  CHECK(settled == doctest::Approx(found).epsilon(1e-2));
  for (int k = 2; k < 5000; ++k) {
    (void)identifier.update(10s + k * 1ms, {One(middle + jitter(random)), One(any(random))}, Ones(any(random)));
    REQUIRE(identifier.friction().coulomb[0] == settled);
  }
}

TEST_CASE("what is found stays within its range, whatever the torque") {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const double torque : {-50.0, -1.0, 1.0, 50.0}) {
    Identifier identifier(up_to(0.1, 0.05));
    Swing joint(torque, torque);
    (void)joint.run(identifier, 3);
    CHECK(identifier.friction().coulomb[0] == (torque > 0 ? 0.1 : 0.0));
    CHECK(identifier.friction().viscous[0] == (torque > 0 ? 0.05 : 0.0));
  }
  Identifier identifier(up_to(0.1, 0.05));
  for (int k = 0; k < 10'000; ++k) {
    (void)identifier.update(k * 1ms, {One(any(random)), One(9 * any(random))}, Ones(1e3 * any(random)));
    const double f_c = identifier.friction().coulomb[0], f_v = identifier.friction().viscous[0];
    REQUIRE((0 <= f_c && f_c <= 0.1 && 0 <= f_v && f_v <= 0.05));
  }
}

TEST_CASE("an input that is not finite, one that is out of range, and a clock that stands change nothing") {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  Identifier identifier(up_to(0.1)), twin(up_to(0.1));
  Swing joint(0.05), same = joint;
  for (int round = 0; round < 20; ++round) {
    (void)joint.run(identifier, 0.1);
    (void)same.run(twin, 0.1);
    CHECK(identifier.friction().coulomb[0] == twin.friction().coulomb[0]);
    const Time between = (round + 1) * 100ms - 500us;
    for (const double bad : {nan, infinity, -infinity}) {
      CHECK(identifier.update(between, {One(bad), One(0.0)}, Ones(0.0)) == Status::not_finite);
      CHECK(identifier.update(between, {One(0.0), One(bad)}, Ones(0.0)) == Status::not_finite);
      CHECK(identifier.update(between, {One(0.0), One(0.0)}, Ones(bad)) == Status::not_finite);
    }
    CHECK(identifier.update(between, {One(1e307), One(0.0)}, Ones(0.0)) == Status::not_finite);
    CHECK(identifier.update(between, {One(1.0), One(0.0)}, Ones(1e308)) == Status::not_finite);
    CHECK(identifier.update(between, {One(0.0), One(1e200)}, Ones(0.0)) == Status::not_finite);
    CHECK(identifier.update(between - 1ms, {One(1.0), One(0.0)}, Ones(0.0)) == Status::clock_backwards);
  }
}

TEST_CASE("no call allocates") {
  FrictionIdentifier<3> identifier({.largest = {0.1, 0.1, 0.1}});
  limpid::test::check_no_allocation([&] {
    for (int k = 0; k < 100; ++k) {
      (void)identifier.update(k * 1ms, {{0.01 * k, 0, 0}, {10, 0, 0}}, Eigen::Array3d(0.1, 0.2, 0.3));
    }
  });
}

TEST_CASE("settings that cannot serve are refused by name") {
  CHECK_THROWS_WITH_AS(Identifier({}), "FrictionIdentifier: largest: expected finite and > 0, got nan",
                       std::invalid_argument);
  const auto refused = [](auto change, const char* message) {
    auto settings = up_to(0.1);
    change(settings);
    CHECK_THROWS_WITH_AS(Identifier{settings}, message, std::invalid_argument);
  };
  refused([](auto& s) { s.largest[0] = 1e-200; },
          "FrictionIdentifier: largest: expected a square in range, got 1e-200");
  refused([](auto& s) { s.largest_viscous[0] = -1; },
          "FrictionIdentifier: largest_viscous: expected finite and >= 0, got -1");
  refused([](auto& s) { s.start[0] = 0.2; }, "FrictionIdentifier: start: expected of [0, largest], got 0.2");
  refused([](auto& s) { s.presliding[0] = 0; }, "FrictionIdentifier: presliding: expected finite and > 0, got 0");
  refused([](auto& s) { s.encoder_step[0] = -1; },
          "FrictionIdentifier: encoder_step: expected finite and >= 0, got -1");
  refused([](auto& s) { s.bandwidth = 0; }, "FrictionIdentifier: bandwidth: expected finite and > 0, got 0");
  refused([](auto& s) { s.memory = 0; }, "FrictionIdentifier: memory: expected finite and > 0, got 0");
  refused([](auto& s) { s.prior = 0; }, "FrictionIdentifier: prior: expected finite and > 0, got 0");
}
