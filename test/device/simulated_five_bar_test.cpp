// SPDX-License-Identifier: MIT
#include <limpid/device/simulated_five_bar.hpp>

#include <conformance/haptic_device_suite.hpp>
#include <support/maximum.hpp>
#include <support/no_allocation.hpp>
#include <support/permit.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <type_traits>

using limpid::FiveBar;
using limpid::HapticDevice;
using limpid::Realism;
using limpid::SimulatedFiveBar;
using limpid::Status;
using limpid::Time;
using limpid::test::maximum;
using limpid::test::permit;
using namespace std::chrono_literals;

static_assert(HapticDevice<SimulatedFiveBar<>>);
static_assert(!std::is_constructible_v<SimulatedFiveBar<>>);  // its settings are asked for

namespace {

using Vector = Eigen::Vector2d;
using Force = Eigen::Vector3d;

const Force none = Force::Zero();
const Vector start = SimulatedFiveBar<>::start_pose();

auto safe(const Vector& torque) { return permit(FiveBar<>{}, torque); }

FiveBar<>::Parameters without_friction() { return FiveBar<>{}.theta_of({.friction = 0}); }

double kinetic_energy(const SimulatedFiveBar<>& device, const FiveBar<>::Parameters& theta) {
  const auto [q, qdot] = device.true_state();
  return qdot.dot(FiveBar<>{}.at(q).H(theta) * qdot) / 2;
}

Force tip(const SimulatedFiveBar<>& device) { return FiveBar<>{}.at(device.true_state().q).position(); }

}  // namespace

TEST_CASE("the simulated five-bar is a haptic device") {
  for (const Realism realism : {Realism::ideal, Realism::realistic}) {
    SimulatedFiveBar<> device({.realism = realism});
    limpid::test::check_haptic_device(
        device, [&](Time now) { CHECK(device.advance(now, none) == Status::ok); }, [&] { device.disconnect(); });
  }
}

TEST_CASE("it starts with its tip where the notes have it") {
  SimulatedFiveBar<> device({});
  CHECK((tip(device) - Force(0.08, 0.22, 0)).norm() < 1e-15);  // some roundings of 0.2 m
}

TEST_CASE("an ideal device without friction keeps its energy as it swings") {
  const auto theta = without_friction();
  SimulatedFiveBar<> device({.theta = theta});
  (void)device.advance(0ms, none);
  (void)device.write(safe({0.02, -0.03}));
  for (int k = 1; k <= 20; ++k) (void)device.advance(k * 1ms, none);
  (void)device.write({});
  const double before = kinetic_energy(device, theta);
  const Vector from = device.true_state().q;
  for (int k = 21; k <= 120; ++k) REQUIRE(device.advance(k * 1ms, none) == Status::ok);
  CHECK((device.true_state().q - from).norm() > 0.1);  // it did swing
  CHECK(before > 1e-4);
  CHECK(std::abs(kinetic_energy(device, theta) - before) < 1e-8 * before);  // 100 steps of 1e-10
}

TEST_CASE("of the work of an ideal device's motors what viscous friction does not take is kinetic energy") {
  const auto theta = FiveBar<>{}.theta_of({});
  const Vector torque(0.01, -0.015);
  SimulatedFiveBar<> device({});
  (void)device.advance(0ms, none);
  (void)device.write(safe(torque));
  double heat = 0;  // by Simpson's rule over steps of 0.2 ms: smooth over 100 ms, 1e-12
  Vector before = Vector::Zero();
  for (int k = 1; k <= 500; ++k) {
    (void)device.advance(k * 200us - 100us, none);
    const Vector middle = device.true_state().qdot;
    REQUIRE(device.advance(k * 200us, none) == Status::ok);
    const Vector after = device.true_state().qdot;
    heat += 1.1e-3 * 2e-4 / 6 * (before.squaredNorm() + 4 * middle.squaredNorm() + after.squaredNorm());
    before = after;
  }
  const double work = torque.dot(device.true_state().q - start);
  CHECK(heat > 1e-6);
  CHECK(std::abs(work - heat - kinetic_energy(device, theta)) < 1e-8 * work);
}

TEST_CASE("on an ideal device a controller's -J' F_h cancels the operator's force exactly") {
  SimulatedFiveBar<> pushed({});
  for (int k = 0; k <= 200; ++k) {
    const Force F_h(std::sin(0.02 * k), 0.5, 3);
    (void)pushed.advance(k * 1ms, F_h);
    (void)pushed.write(safe(-FiveBar<>{}.at(pushed.read(k * 1ms).q).jacobian().transpose() * F_h));
  }
  CHECK(pushed.true_state().q == start);
  CHECK(pushed.true_state().qdot == Vector(0, 0));
}

// The converter's steps are 2 N m / 2^11 = 0.977 mN m. Each torque moves a device of its own, without friction.
TEST_CASE("a torque is converted to the nearest of 4096 levels") {
  const double level = 2.0 / 2048;
  const auto moved = [&](const Vector& torque, int bits) {
    SimulatedFiveBar<> device({.theta = without_friction(),
                               .realism = Realism::realistic,
                               .converter_bits = bits,
                               .static_friction = {0, 0}});
    (void)device.advance(0ms, none);
    (void)device.write(safe(torque));
    (void)device.advance(10ms, none);
    return device.true_state().q;
  };
  CHECK(moved({0.49 * level, -0.49 * level}, 12) == start);
  CHECK(moved({0.51 * level, -0.51 * level}, 12) == moved({level, -level}, 12));
  CHECK(moved({20.3 * level, -7.4 * level}, 12) == moved({20 * level, -7 * level}, 12));
  CHECK(moved({20 * level, -7 * level}, 12) == moved({20 * level, -7 * level}, 0));  // on a level nothing changes
  CHECK(moved({20.3 * level, 0}, 0) != moved({20 * level, 0}, 0));
}

TEST_CASE("the converter reaches from -2 N m to a step below 2 N m, and says where it ends") {
  SimulatedFiveBar<> device({.realism = Realism::realistic}), top({.realism = Realism::realistic});
  (void)device.advance(0ms, none);
  (void)top.advance(0ms, none);
  const double highest = 2 - 2.0 / 2048;
  CHECK(top.write(safe({highest, -2})) == Status::ok);
  CHECK(device.write(safe({2, -2})) == Status::limited);
  CHECK(device.write(safe({highest, -2.001})) == Status::limited);
  CHECK(device.write(safe({7, -7})) == Status::limited);
  CHECK(top.advance(1ms, none) == Status::ok);
  CHECK(device.advance(1ms, none) == Status::ok);
  CHECK(device.true_state().q == top.true_state().q);
  SimulatedFiveBar<> ideal({});
  CHECK(ideal.write(safe({7, -7})) == Status::ok);
}

// Under a torque below f_s a joint bends, by -z_s ln(1 - tau/f_s) at most after Dahl's law, and stays.
TEST_CASE("a converter of more bits than an integer has, or less than none, has its step all the same") {
  limpid::ArmHardware<1> hardware{.torque = Eigen::Matrix<double, 1, 1>(2.0), .converter_bits = 64};
  CHECK(hardware.converter_step()[0] == std::ldexp(1.0, -62));
  hardware.converter_bits = -1;
  CHECK(hardware.converter_step()[0] == 0);
}

TEST_CASE("friction holds the device against less torque than its own, and lets it go under more") {
  const auto moved = [](const Vector& torque) {
    SimulatedFiveBar<> device({.realism = Realism::realistic, .converter_bits = 0});
    (void)device.advance(0ms, none);
    for (int k = 1; k <= 500; ++k) {
      (void)device.write(safe(torque * std::min(1.0, k / 400.0)));
      REQUIRE(device.advance(k * 1ms, none) == Status::ok);
    }
    return Vector(device.true_state().q - start);
  };
  const double bend = 2e-4 * std::log(2.0);
  const Vector held = moved({1e-3, -1e-3});
  CHECK(held[0] == doctest::Approx(bend).epsilon(0.05));  // it swings a little beyond what is quasi-static
  CHECK(held[1] == doctest::Approx(-bend).epsilon(0.05));
  CHECK(moved({4e-3, 0})[0] > 0.05);
}

// A tip that coasts at v: F_s = f_s sign of the rates, (1) with H(q') = f_s sign q'.
TEST_CASE("a sliding joint is braked by its Coulomb friction beside the viscous one") {
  const Vector f_s(2e-3, 2e-3), torque(-0.01, 0.012);
  const auto theta = FiveBar<>{}.theta_of({});
  SimulatedFiveBar<> device({.realism = Realism::realistic, .converter_bits = 0});
  (void)device.advance(0ms, none);
  (void)device.write(safe(torque));
  for (int k = 1; k <= 60; ++k) REQUIRE(device.advance(k * 1ms, none) == Status::ok);
  const auto [q, qdot] = device.true_state();
  REQUIRE((qdot.array().abs() > 0.2).all());
  (void)device.advance(60ms + 10us, none);
  const Vector qddot = (device.true_state().qdot - qdot) / 1e-5;
  const auto pose = FiveBar<>{}.at(q);
  const Vector sign = qdot.cwiseSign();
  const Vector braking = torque - pose.H(theta) * qddot - (pose.C(theta, qdot) + pose.B(theta)) * qdot;
  CHECK((braking - f_s.cwiseProduct(sign)).cwiseAbs().maxCoeff() < 0.01 * 2e-3);  // of a difference over 10 us
}

TEST_CASE("a realistic device loses energy as it coasts until it stands, and then keeps standing") {
  const auto theta = FiveBar<>{}.theta_of({});
  SimulatedFiveBar<> device({.realism = Realism::realistic});
  (void)device.advance(0ms, none);
  (void)device.write(safe({-0.01, 0.012}));
  for (int k = 1; k <= 30; ++k) (void)device.advance(k * 1ms, none);
  (void)device.write({});
  // A bent joint springs back: f_s z_s/2 for each of them may go to and fro
  double least = kinetic_energy(device, theta), worst = 0;
  for (int k = 31; k <= 1000; ++k) {
    REQUIRE(device.advance(k * 1ms, none) == Status::ok);
    const double energy = kinetic_energy(device, theta);
    worst = maximum(worst, energy - least);
    least = std::min(least, energy);
  }
  CHECK(worst <= 2e-3 * 2e-4);
  const Vector stands = device.true_state().q;
  for (int k = 1001; k <= 1500; ++k) (void)device.advance(k * 1ms, none);
  CHECK((device.true_state().q - stands).norm() < 1e-5);
}

TEST_CASE("angles come in steps of 2^-16 of a turn, and rates through their filter from them") {
  SimulatedFiveBar<> device({.realism = Realism::realistic});
  limpid::FilteredDerivative<2> filter({.time_constant = 5e-4});
  (void)device.write(safe({0.01, -0.01}));
  const double step = 2 * std::acos(-1.0) / 65536;
  for (int k = 0; k <= 50; ++k) {
    (void)device.advance(k * 1ms, none);
    const auto seen = device.read(k * 1ms);
    const Eigen::Array2d steps = seen.q.array() / step;
    CHECK((steps - steps.round()).abs().maxCoeff() < 1e-10);  // a division of 2e4 steps
    CHECK((seen.q - device.true_state().q).cwiseAbs().maxCoeff() < step / 2 * (1 + 1e-9));
    CHECK((seen.qdot.array() == filter.update(k * 1ms, seen.q.array()).value).all());
  }
}

TEST_CASE("a clamp holds the tip along its axis, and lets it go along the other") {
  for (const Realism realism : {Realism::ideal, Realism::realistic}) {
    SimulatedFiveBar<> device({.realism = realism, .locked = {false, true}});
    (void)device.advance(0ms, none);
    (void)device.write(safe(FiveBar<>{}.at(start).jacobian().transpose() * Force(0.1, 5, 0)));
    for (int k = 1; k <= 100; ++k) REQUIRE(device.advance(k * 1ms, {0.1, -2, 0}) == Status::ok);
    CHECK(tip(device)[0] - 0.08 > 0.01);
    CHECK(std::abs(tip(device)[1] - 0.22) < 1e-8);  // 100 steps of 1e-10
  }
}

TEST_CASE("where the loop would have to open the device stays before that") {
  SimulatedFiveBar<> device({});
  (void)device.advance(0ms, none);
  Status status = Status::ok;
  for (int k = 1; k <= 2000 && status == Status::ok; ++k) status = device.advance(k * 1ms, {0, -2, 0});
  CHECK(has(status, Status::not_finite | Status::limited));
  CHECK(limpid::is_finite(device.true_state()));
  CHECK(limpid::is_finite(FiveBar<>{}.at(device.true_state().q).position()));
}

TEST_CASE("before a singularity the device stops, and is drawn away again") {
  for (const Realism realism : {Realism::ideal, Realism::realistic}) {
    SimulatedFiveBar<> device({.realism = realism});
    (void)device.advance(0ms, none);
    int k = 1;
    while (k < 2000 && device.advance(k * 1ms, {0, -2, 0}) == Status::ok) ++k;
    REQUIRE(k < 2000);
    const Eigen::Vector2d there = device.true_state().q;
    CHECK(device.advance((k + 1) * 1ms, {0, 2, 0}) != Status::ok);  // the last force and its speed carry it on
    CHECK(device.true_state().q == there);
    CHECK(device.true_state().qdot == Eigen::Vector2d::Zero());
    for (int j = 2; j <= 50; ++j) REQUIRE(device.advance((k + j) * 1ms, {0, 2, 0}) == Status::ok);
    CHECK(tip(device)[1] > FiveBar<>{}.at(there).position()[1] + 0.01);
  }
}

TEST_CASE("a force that it cannot follow does not hold the device for ever") {
  for (const Realism realism : {Realism::ideal, Realism::realistic}) {
    SimulatedFiveBar<> device({.realism = realism});
    (void)device.advance(0ms, {1e300, 0, 0});
    CHECK(device.advance(1ms, none) != Status::ok);
    CHECK(device.advance(2ms, none) != Status::ok);
    CHECK(device.true_state().q == SimulatedFiveBar<>::start_pose());
    for (int k = 3; k <= 20; ++k) CHECK(device.advance(k * 1ms, {0.1, 0, 0}) == Status::ok);
    CHECK(device.true_state().q != SimulatedFiveBar<>::start_pose());
  }
}

TEST_CASE("a force that is not finite and time that does not advance move nothing") {
  SimulatedFiveBar<> device({.realism = Realism::realistic}), twin({.realism = Realism::realistic});
  (void)device.advance(1ms, {0.1, 0, 0});
  (void)twin.advance(1ms, {0.1, 0, 0});
  CHECK(device.advance(2ms, {std::numeric_limits<double>::quiet_NaN(), 0, 0}) == Status::not_finite);
  CHECK(device.advance(1ms, {9, 9, 0}) == Status::clock_backwards);
  (void)device.advance(2ms, {0.1, 0, 0});
  (void)twin.advance(2ms, {0.1, 0, 0});
  CHECK(device.true_state().q == twin.true_state().q);
}

TEST_CASE("no call of the device's face allocates") {
  for (const Realism realism : {Realism::ideal, Realism::realistic}) {
    SimulatedFiveBar<> device({.realism = realism, .locked = {true, false}});
    const auto torque = safe({0.01, 0.01});
    limpid::test::check_no_allocation([&] {
      for (int k = 0; k < 5; ++k) {
        (void)device.advance(k * 1ms, {0.1, 0.1, 0});
        (void)device.read(k * 1ms);
        (void)device.write(torque);
      }
    });
  }
}

TEST_CASE("settings that cannot be are refused with their field") {
  const double inf = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(SimulatedFiveBar<>({.q0 = {1.8, inf}}), "SimulatedFiveBar: q0: expected finite, got 1.8 inf",
                       std::invalid_argument);
  CHECK_THROWS_AS(SimulatedFiveBar<>({.q0 = {3.0, 0.1}}), std::invalid_argument);  // the loop is open
  CHECK_THROWS_WITH_AS(SimulatedFiveBar<>({.locked = {true, true}}),
                       "SimulatedFiveBar: locked: expected fewer axes than joints, along which the tip can move, got 2",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(SimulatedFiveBar<>({.converter_bits = 25}),
                       "SimulatedFiveBar: converter_bits: expected of [0, 24], got 25", std::invalid_argument);
  CHECK_THROWS_AS(SimulatedFiveBar<>({.static_friction = {-1, 0}}), std::invalid_argument);
  CHECK_THROWS_AS(SimulatedFiveBar<>({.presliding = 0}), std::invalid_argument);
  CHECK_THROWS_AS(SimulatedFiveBar<>({.encoder_step = {0, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(SimulatedFiveBar<>({.rate_filter = 0}), std::invalid_argument);
}
