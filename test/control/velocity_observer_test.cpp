// SPDX-License-Identifier: MIT
#include <limpid/control/computed_torque.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/control/velocity_observer.hpp>
#include <limpid/device/simulated_omni.hpp>
#include <limpid/robot/omni.hpp>

#include <support/maximum.hpp>
#include <support/no_allocation.hpp>
#include <support/pendulum.hpp>

#include <Eigen/SVD>

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using limpid::ComputedTorque;
using limpid::DesiredJoints;
using limpid::in_seconds;
using limpid::Omni;
using limpid::Realism;
using limpid::SafetyLimiter;
using limpid::SimulatedOmni;
using limpid::Status;
using limpid::Time;
using limpid::VelocityObserver;
using limpid::test::maximum;
using limpid::test::Pendulum;
using namespace std::chrono_literals;

namespace {

using One = Eigen::Matrix<double, 1, 1>;
using Three = Eigen::Vector3d;

const Three none = Three::Zero();

// Of I q'' = tau: without gravity and friction.
VelocityObserver<Pendulum<>> of_inertia(double bandwidth) {
  return VelocityObserver<Pendulum<>>({.theta = {0.5, 0, 0}, .bandwidth = bandwidth});
}

DesiredJoints<3> swing(double t) {
  const Three size(0.2, 0.1, -0.15);
  return {SimulatedOmni<>::start_pose() + size * std::sin(4 * t), size * (4 * std::cos(4 * t)),
          size * (-16 * std::sin(4 * t))};
}

// Mean square errors of the rates over 4 s of a swing at .7 rad/s, an operator's force that changes with it.
struct Errors {
  double observer = 0, device = 0;
};

Errors errors_of_rates(Realism realism, Time tick, double bandwidth) {
  SimulatedOmni<> arm({.realism = realism});
  VelocityObserver<Omni<>> observer({.theta = Omni<>::table_5_2(), .bandwidth = bandwidth});
  ComputedTorque<Omni<>> controller({.Lambda = {8, 8, 8}, .Kd = {0.6, 0.5, 0.2}, .theta = Omni<>::table_5_2()});
  SafetyLimiter<Omni<>> limiter({.torque_limit = Three(9, 9, 9)});
  Three applied = none;
  Errors errors;
  for (Time now{0}; now <= 4s; now += tick) {
    const double t = in_seconds(now);
    // the ideal arm holds J' F_h over a tick, which is not the law that the observer takes
    const Three F_h = realism == Realism::ideal ? none : Three(0.5 * std::sin(5 * t), 0, 0.3);
    (void)arm.advance(now, F_h);
    const auto seen = arm.read(now);
    const auto [state, disturbance, status] = observer.update(now, seen.q, applied, F_h);
    REQUIRE(status == Status::ok);
    const auto [torque, limited] =
        limiter.limit(now, seen.joint_state(), controller.update(state, swing(t), F_h).tau, Status::ok);
    REQUIRE(!has(limited, Status::fault));
    (void)arm.write(torque);
    applied = torque.value();
    if (now < 1s) continue;
    const Three rates = arm.true_state().qdot;
    errors.observer += in_seconds(tick) * (state.qdot - rates).squaredNorm() / 3;
    errors.device += in_seconds(tick) * (seen.qdot - rates).squaredNorm() / 3;
  }
  return errors;
}

// -H^-1 (C + B) q', whose slope in q' the condition of convergence bounds.
Three braking(const Three& q, const Three& qdot) {
  const auto theta = Omni<>::table_5_2();
  const auto arm = Omni<>{}.at(q);
  return -arm.H(theta).inverse() * ((arm.C(theta, qdot) + arm.B(theta)) * qdot);
}

}  // namespace

TEST_CASE("a wrong first rate and a torque that is not known are forgotten as a triple pole at exp(-w h) forgets") {
  auto observer = of_inertia(60);
  const double h = 1e-3, z = std::exp(-60 * h);
  // the true joint: at 2 rad/s at the start, under 3 N m of which the observer is told 1
  std::vector<std::array<double, 3>> e;
  for (int k = 0; k < 300; ++k) {
    const double t = k * h, q = 2 * t + 3 * t * t, qdot = 2 + 6 * t;  // q'' = 3/.5
    const auto [state, disturbance, status] = observer.update(k * 1ms, One(q), One(1.0), none);
    REQUIRE(status == Status::ok);
    e.push_back({q - state.q[0], qdot - state.qdot[0], 2 - disturbance[0]});
    if (k < 4) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = [&](int back) { return e[static_cast<std::size_t>(k - back)][i]; };
      const double next = 3 * z * at(1) - 3 * z * z * at(2) + z * z * z * at(3);
      CAPTURE(k);
      CAPTURE(i);
      // roundings of q < .9, times w^2/h in the disturbance
      REQUIRE(std::abs(at(0) - next) < 1e-14 * (i == 0 ? 1 : i == 1 ? 1e3 : 1e7));
    }
  }
  CHECK(std::abs(e.back()[1]) < 1e-4);  // (.3 s w)^2 exp(-.3 s w) of some 2 rad/s
  CHECK(std::abs(e.back()[2]) < 1e-2);
}

TEST_CASE("the rates of an arm that it knows have no lag: their error is of second order in the tick") {
  const double coarse = std::sqrt(errors_of_rates(Realism::ideal, 4ms, 100).observer),
               fine = std::sqrt(errors_of_rates(Realism::ideal, 2ms, 100).observer);
  CAPTURE(coarse);
  CAPTURE(fine);
  CHECK(fine < 2e-3);  // of .7 rad/s
  CHECK(coarse / fine > 3.2);
}

TEST_CASE(
    "behind encoders and with friction that it does not know its rates are three times nearer than the filter's") {
  const Errors errors = errors_of_rates(Realism::realistic, 1ms, 100);
  MESSAGE("observer ", std::sqrt(errors.observer), " rad/s, filter (5.3) ", std::sqrt(errors.device), " rad/s");
  CHECK(9 * errors.observer < errors.device);
}

TEST_CASE("readings in steps leave the noise that the comment says") {
  auto observer = of_inertia(100);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> rounding(-2e-4, 2e-4);  // of a step of 4e-4
  double square = 0;
  constexpr int ticks = 200'000;
  for (int k = 0; k < ticks; ++k) {
    const double rate = observer.update(k * 1ms, One(rounding(random)), One(0.0), none).state.qdot[0];
    if (k > 1000) square += rate * rate / ticks;
  }
  // d/sqrt(12) sqrt(h) times 1.323 w^1.5, the H2 norm of (3 w^2 s^2 + w^3 s)/(s + w)^3; sampled, w h = .1 moves it by
  // a part of that order
  const double expected = 4e-4 / std::sqrt(12.0) * std::sqrt(1e-3) * std::sqrt(1.75) * 1e3;
  CHECK(std::sqrt(square) == doctest::Approx(expected).epsilon(0.15));
}

TEST_CASE("the condition of convergence: the peak of 1.188/w, and an Omni that is well within it at the default") {
  double peak = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = 1e-4 * i;  // (omega/w)^2
    peak = maximum(peak, std::sqrt(x * (x + 9) / std::pow(1 + x, 3)));
  }
  CHECK(peak == doctest::Approx(1.188).epsilon(5e-4));  // as printed

  const auto limits = Omni<>{}.limits();
  std::mt19937 random(52);
  std::uniform_real_distribution<double> part(0, 1);
  double L = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    Three q, qdot;
    for (int i = 0; i < 3; ++i) {
      q[i] = limits.lower[i] + part(random) * (limits.upper[i] - limits.lower[i]);
      qdot[i] = 5 * (2 * part(random) - 1);
    }
    Eigen::Matrix3d slope;
    for (int i = 0; i < 3; ++i) {
      const Three step = 0.5 * Three::Unit(i);  // quadratic in q': central differences are exact
      slope.col(i) = braking(q, qdot + step) - braking(q, qdot - step);
    }
    L = maximum(L, slope.jacobiSvd().singularValues()[0]);
  }
  CHECK(L < 40);
  CHECK(L < VelocityObserver<Omni<>>::Settings{}.bandwidth / 1.188);
}

TEST_CASE("the operator's force is not taken for a disturbance") {
  VelocityObserver<Pendulum<>> told({.theta = {0.5, 0, 0}}), untold({.theta = {0.5, 0, 0}});
  One disturbance(0.0), blamed(0.0);
  for (int k = 0; k <= 1000; ++k) {  // a joint that is held still by -J' F_h
    disturbance = told.update(k * 1ms, One(0.0), One(-2.0), {2, 0, 0}).disturbance;
    blamed = untold.update(k * 1ms, One(0.0), One(-2.0), none).disturbance;
  }
  CHECK(disturbance[0] == 0);
  CHECK(blamed[0] == doctest::Approx(2).epsilon(1e-9));
}

TEST_CASE_TEMPLATE("in any scalar it follows the same joint", Scalar, float, double, long double) {
  using Joint = Eigen::Matrix<Scalar, 1, 1>;
  VelocityObserver<Pendulum<Scalar>> observer({.theta = {Scalar(0.5), Scalar(0), Scalar(0)}});
  Scalar rate(0);
  for (int k = 0; k <= 500; ++k) {
    const Scalar t = Scalar(k) / Scalar(1000);
    rate = observer.update(k * 1ms, Joint(t), Joint(Scalar(0)), {Scalar(0), Scalar(0), Scalar(0)}).state.qdot[0];
  }
  CHECK(std::abs(rate - 1) < Scalar(1e-3));  // (.5 s w)^2 exp(-.5 s w) and, in float, w^1.5 sqrt(h) roundings of q
}

TEST_CASE("after a pause longer than the longest step it starts again where the joint is, at rest") {
  auto observer = of_inertia(100);
  for (int k = 0; k < 100; ++k) (void)observer.update(k * 1ms, One(1e-3 * k), One(1.0), none);
  const auto [state, disturbance, status] = observer.update(99ms + 21ms, One(7.0), One(1.0), none);
  CHECK(state.q[0] == 7);
  CHECK(state.qdot[0] == 0);
  CHECK(disturbance[0] == 0);
  CHECK(status == Status::ok);
}

TEST_CASE("an input that is not finite, or leads out of range, and a clock that stands change nothing") {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  VelocityObserver<Omni<>> observer({.theta = Omni<>::table_5_2()}), twin({.theta = Omni<>::table_5_2()});
  const Three q(0.1, 0.8, -1.3);
  for (int k = 0; k < 50; ++k) {
    const Three moved = q + 1e-3 * k * Three(1, -1, 1);
    const auto before = observer.update(k * 1ms, moved, {0.1, 0, 0}, {1, 0, 0});
    const auto same = twin.update(k * 1ms, moved, {0.1, 0, 0}, {1, 0, 0});
    CHECK(before.state.q == same.state.q);
    CHECK(before.state.qdot == same.state.qdot);
    CHECK(before.disturbance == same.disturbance);
    for (const double bad : {nan, infinity, -infinity}) {
      for (std::size_t input = 0; input < 3; ++input) {
        std::array<Three, 3> inputs{moved, Three(0.1, 0, 0), Three(1, 0, 0)};
        inputs[input][k % 3] = bad;
        const auto after = observer.update(k * 1ms + 500us, inputs[0], inputs[1], inputs[2]);
        CHECK(after.status == Status::not_finite);
        CHECK(after.state.q == before.state.q);
        CHECK(after.state.qdot == before.state.qdot);
        CHECK(after.disturbance == before.disturbance);
      }
    }
    const Three far = Three::Constant(std::numeric_limits<double>::max());
    if (k > 0) CHECK(observer.update(k * 1ms + 500us, far, none, none).status == Status::not_finite);
    CHECK(observer.update(k * 1ms, q, none, none).status == Status::clock_backwards);
  }
}

TEST_CASE("no call allocates") {
  VelocityObserver<Omni<>> observer({.theta = Omni<>::table_5_2()});
  limpid::test::check_no_allocation([&] {
    for (int k = 0; k < 20; ++k) (void)observer.update(k * k * 1ms, {0.1, 0.8, -1.3}, none, none);
  });
}

TEST_CASE("settings that cannot serve are refused by name") {
  using Observer = VelocityObserver<Pendulum<>>;
  CHECK_THROWS_WITH_AS(Observer({}), "VelocityObserver: theta: expected finite, got nan nan nan",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Observer({.theta = {1, 1, 1}, .bandwidth = 0}),
                       "VelocityObserver: bandwidth: expected finite and > 0, got 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Observer({.theta = {1, 1, 1}, .longest_step = 0s}),
                       "VelocityObserver: longest_step: expected > 0 s, got 0 s", std::invalid_argument);
}
