// SPDX-License-Identifier: MIT
#include <limpid/control/computed_torque.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/device/simulated_omni.hpp>
#include <limpid/robot/omni.hpp>

#include <support/no_allocation.hpp>
#include <support/pendulum.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>

using limpid::ComputedTorque;
using limpid::DesiredJoints;
using limpid::JointState;
using limpid::Omni;
using limpid::SlotineLiAdaptive;
using limpid::Status;
using limpid::Time;
using limpid::test::Pendulum;
using namespace std::chrono_literals;

namespace {

using One = Eigen::Matrix<double, 1, 1>;

template <typename Scalar>
using Vector = Eigen::Matrix<Scalar, 3, 1>;

template <typename Scalar>
typename SlotineLiAdaptive<Omni<Scalar>>::Settings thesis_settings() {  // (5.6), (5.7), Table 5.2
  typename SlotineLiAdaptive<Omni<Scalar>>::Settings settings;
  settings.Lambda = Vector<Scalar>(Scalar(2.8), Scalar(3.0), Scalar(1.5));
  settings.Kd = Vector<Scalar>(Scalar(0.4), Scalar(0.28), Scalar(0.10));
  settings.Gamma << Scalar(.01), Scalar(.002), Scalar(.002), Scalar(.0005), Scalar(.001), Scalar(.001), Scalar(.02),
      Scalar(.02), Scalar(.02);
  settings.theta0 = Omni<Scalar>::table_5_2();
  return settings;
}

template <typename Scalar>
JointState<3, Scalar> some_state(Scalar t) {
  using std::cos, std::sin;
  return {{sin(t), Scalar(0.9) + Scalar(0.5) * cos(2 * t), Scalar(-1.3)}, {cos(t), -sin(2 * t), Scalar(0.25)}};
}

template <typename Scalar>
DesiredJoints<3, Scalar> some_target(Scalar t) {
  using std::cos;
  return {{Scalar(0.1), cos(t), Scalar(-1.5)}, {Scalar(1), Scalar(0.5), cos(t)}, {Scalar(3), Scalar(-2), Scalar(1)}};
}

SlotineLiAdaptive<Pendulum<>>::Settings pendulum_settings() {
  return {.Lambda = One(4.0), .Kd = One(2.0), .Gamma = {0.5, 0.25, 1.0}, .theta0 = {0.5, 8.0, 0.25}};
}

}  // namespace

TEST_CASE("without adaptation gain it is the controller for known parameters, bit for bit") {
  auto settings = thesis_settings<double>();
  settings.Gamma.setZero();
  SlotineLiAdaptive<Omni<>> adaptive(settings);
  ComputedTorque<Omni<>> known({.Lambda = settings.Lambda, .Kd = settings.Kd, .theta = settings.theta0});
  for (int k = 0; k < 100; ++k) {
    const double t = 0.05 * k;
    const Vector<double> F_h(std::sin(t), 1, -2);
    const Vector<double> tau = adaptive.update(k * 1ms, some_state(t), some_target(t), F_h).tau;
    CHECK(tau == known.update(some_state(t), some_target(t), F_h).tau);
  }
}

TEST_CASE("the first call adapts nothing; the second one the mean of both directions over the time between") {
  SlotineLiAdaptive<Pendulum<>> controller(pendulum_settings());
  const JointState<1> is{One(0.0), One(1.0)};
  // q_r' = 2 + 4 * .5 = 4, q_r'' = 16 + 4 = 20, delta = -3; sin q = 0: phi_r' delta = (-60, 0, -12)
  CHECK(controller.update(7ms, is, {One(0.5), One(2.0), One(16.0)}, {0, 0, 0}).tau[0] == 17.0);
  CHECK(controller.theta_hat() == Eigen::Vector3d(0.5, 8.0, 0.25));
  // q_r' = 2, q_r'' = 4 + 4 = 8, delta = -1: phi_r' delta = (-8, 0, -2); mean (-34, 0, -7), over 1/64 s
  const auto [tau, status] = controller.update(7ms + 15'625us, is, {One(0.0), One(2.0), One(4.0)}, {0, 0, 0});
  CHECK(status == Status::ok);
  CHECK(controller.theta_hat()[0] == 0.5 + 0.5 * 34 / 64);  // exact in binary
  CHECK(controller.theta_hat()[1] == 8.0);
  CHECK(controller.theta_hat()[2] == 0.25 + 7.0 / 64);
  CHECK(tau[0] == 8 * controller.theta_hat()[0] + 2 * controller.theta_hat()[2] + 2);  // with the new theta_hat
}

TEST_CASE_TEMPLATE("the Omni's parameters move as the dense regressor says", Scalar, float, double, long double) {
  const auto settings = thesis_settings<Scalar>();
  SlotineLiAdaptive<Omni<Scalar>> controller(settings);
  const auto direction = [&](Scalar t) {
    const auto is = some_state(t);
    const auto wanted = some_target(t);
    const Vector<Scalar> qdot_r = wanted.qdot - settings.Lambda.cwiseProduct(is.q - wanted.q);
    const Vector<Scalar> qddot_r = wanted.qddot - settings.Lambda.cwiseProduct(is.qdot - wanted.qdot);
    return Eigen::Matrix<Scalar, 9, 1>(Omni<Scalar>{}.at(is.q).regressor(is.qdot, qdot_r, qddot_r).transpose() *
                                       (is.qdot - qdot_r));
  };
  Eigen::Matrix<Scalar, 9, 1> theta_hat = settings.theta0;
  const Scalar dt = Scalar(1) / Scalar(500);
  for (int k = 0; k < 50; ++k) {
    const Scalar t = Scalar(k) * dt;
    if (k > 0) theta_hat -= dt / 2 * settings.Gamma.cwiseProduct(direction(t - dt) + direction(t));
    (void)controller.update(k * 2ms, some_state(t), some_target(t), {Scalar(1), Scalar(2), Scalar(3)});
  }
  // directions below 500: 50 steps of some ten roundings of 500 * dt * Gamma < 0.02, and of theta < 0.5
  CHECK((controller.theta_hat() - theta_hat).cwiseAbs().maxCoeff() < 500 * std::numeric_limits<Scalar>::epsilon());
}

TEST_CASE("an estimate at its bound stays there, says so, and comes back when the direction turns") {
  auto settings = pendulum_settings();
  settings.lower = {0.4, 8.0, 0.25};
  settings.upper = {0.75, 8.0, std::numeric_limits<double>::infinity()};
  SlotineLiAdaptive<Pendulum<>> controller(settings);
  const JointState<1> is{One(0.0), One(1.0)};
  const DesiredJoints<1> up{One(0.5), One(2.0), One(16.0)}, down{One(0.5), One(2.0), One(-28.0)};  // q_r'' = 20, -24
  Time now = 0ms;
  Status status = controller.update(now, is, up, {0, 0, 0}).status;
  for (int k = 0; k < 50; ++k) status = controller.update(now += 1ms, is, up, {0, 0, 0}).status;
  CHECK(status == Status::at_bound);
  CHECK(controller.theta_hat()[0] == 0.75);
  CHECK(controller.theta_hat()[1] == 8.0);
  CHECK(controller.theta_hat()[2] > 0.8);  // .25 + 1 * 12 * .05, free
  for (int k = 0; k < 5; ++k) status = controller.update(now += 1ms, is, down, {0, 0, 0}).status;
  CHECK(status == Status::ok);
  CHECK(controller.theta_hat()[0] < 0.75);
}

TEST_CASE("a pause longer than the longest step is not adapted over") {
  SlotineLiAdaptive<Pendulum<>> controller(pendulum_settings());
  const JointState<1> is{One(0.3), One(1.0)};
  const DesiredJoints<1> wanted{One(0.5), One(2.0), One(16.0)};
  (void)controller.update(0ms, is, wanted, {0, 0, 0});
  (void)controller.update(101ms, is, wanted, {0, 0, 0});
  CHECK(controller.theta_hat() == Eigen::Vector3d(0.5, 8.0, 0.25));
  (void)controller.update(102ms, is, wanted, {0, 0, 0});
  CHECK(controller.theta_hat() != Eigen::Vector3d(0.5, 8.0, 0.25));
}

TEST_CASE("time that does not advance changes nothing") {
  SlotineLiAdaptive<Pendulum<>> controller(pendulum_settings());
  const JointState<1> is{One(0.3), One(1.0)};
  const DesiredJoints<1> wanted{One(0.5), One(2.0), One(16.0)};
  const One good = controller.update(5ms, is, wanted, {0, 0, 0}).tau;
  for (const Time now : {Time{5ms}, Time{4ms}}) {
    const auto [tau, status] = controller.update(now, is, {One(0.0), One(0.0), One(0.0)}, {0, 0, 0});
    CHECK(status == Status::clock_backwards);
    CHECK(tau == good);
  }
}

TEST_CASE("a non-finite entry of any input leaves no trace but its status") {
  SlotineLiAdaptive<Omni<>> controller(thesis_settings<double>()), twin(thesis_settings<double>());
  int k = 0;
  const auto same = [&] {
    ++k;
    const double t = 0.01 * k;
    const auto tau = controller.update(k * 1ms, some_state(t), some_target(t), {1, 2, 3}).tau;
    CHECK(tau == twin.update(k * 1ms, some_state(t), some_target(t), {1, 2, 3}).tau);
    CHECK(controller.theta_hat() == twin.theta_hat());
    return tau;
  };
  same();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    for (int input = 0; input < 6; ++input) {
      for (int i = 0; i < 3; ++i) {
        const auto good = same();
        auto is = some_state(0.01 * k);
        auto wanted = some_target(0.01 * k);
        Eigen::Vector3d F_h(1, 2, 3);
        Eigen::Vector3d* const inputs[] = {&is.q, &is.qdot, &wanted.q, &wanted.qdot, &wanted.qddot, &F_h};
        (*inputs[input])[i] = bad;
        const auto [tau, status] = controller.update(k * 1ms + 500us, is, wanted, F_h);
        CHECK(status == Status::not_finite);
        CHECK(tau == good);
      }
    }
  }
  same();
}

TEST_CASE("a finite input that would make an estimate overflow changes nothing") {
  SlotineLiAdaptive<Pendulum<>> controller(pendulum_settings());
  (void)controller.update(0ms, {One(0.0), One(0.0)}, {}, {0, 0, 0});
  CHECK(controller.update(1ms, {One(0.0), One(1e200)}, {}, {0, 0, 0}).status == Status::not_finite);
  CHECK(controller.theta_hat() == Eigen::Vector3d(0.5, 8.0, 0.25));
}

TEST_CASE("over an interval in which the device had another torque nothing is adapted, and after it all goes on") {
  SlotineLiAdaptive<Pendulum<>> controller(pendulum_settings()), twin(pendulum_settings());
  const JointState<1> is{One(0.3), One(1.0)};
  const DesiredJoints<1> wanted{One(0.5), One(2.0), One(16.0)};
  const One first = controller.update(0ms, is, wanted, {0, 0, 0}, One(0.0)).tau;
  (void)controller.update(1ms, is, wanted, {0, 0, 0}, One(0.0));  // a limiter's fault
  CHECK(controller.theta_hat() == Eigen::Vector3d(0.5, 8.0, 0.25));
  const One again = controller.update(2ms, is, wanted, {0, 0, 0}, One(std::nextafter(first[0], 0.0))).tau;
  CHECK(controller.theta_hat() == Eigen::Vector3d(0.5, 8.0, 0.25));
  (void)controller.update(3ms, is, wanted, {0, 0, 0}, again);
  (void)twin.update(2ms, is, wanted, {0, 0, 0});
  (void)twin.update(3ms, is, wanted, {0, 0, 0});
  CHECK(controller.theta_hat() == twin.theta_hat());
  CHECK(controller.theta_hat() != Eigen::Vector3d(0.5, 8.0, 0.25));
}

TEST_CASE("an interval that is to be skipped is not adapted over, and the one after it is") {
  SlotineLiAdaptive<Pendulum<>> controller(pendulum_settings()), twin(pendulum_settings());
  const JointState<1> is{One(0.3), One(1.0)};
  const DesiredJoints<1> wanted{One(0.5), One(2.0), One(16.0)};
  (void)controller.update(0ms, is, wanted, {0, 0, 0});
  controller.skip_adaptation();
  (void)controller.update(1ms, is, wanted, {0, 0, 0});
  CHECK(controller.theta_hat() == Eigen::Vector3d(0.5, 8.0, 0.25));
  (void)controller.update(2ms, is, wanted, {0, 0, 0});
  (void)twin.update(1ms, is, wanted, {0, 0, 0});
  (void)twin.update(2ms, is, wanted, {0, 0, 0});
  CHECK(controller.theta_hat() == twin.theta_hat());
}

TEST_CASE("a torque that another component added is no other torque than asked for") {
  SlotineLiAdaptive<Pendulum<>> controller(pendulum_settings()), twin(pendulum_settings());
  const JointState<1> is{One(0.3), One(1.0)};
  const DesiredJoints<1> wanted{One(0.5), One(2.0), One(16.0)};
  One own = controller.update(0ms, is, wanted, {0, 0, 0}, One(0.0), One(0.0)).tau;
  (void)twin.update(0ms, is, wanted, {0, 0, 0});
  for (int k = 1; k < 10; ++k) {
    const One added(0.1 * k);
    own = controller.update(k * 1ms, is, wanted, {0, 0, 0}, own + added, added).tau;
    CHECK(own == twin.update(k * 1ms, is, wanted, {0, 0, 0}).tau);
  }
  CHECK(controller.theta_hat() == twin.theta_hat());
  CHECK(controller.theta_hat() != Eigen::Vector3d(0.5, 8.0, 0.25));
  const auto before = controller.theta_hat();
  (void)controller.update(10ms, is, wanted, {0, 0, 0}, own, One(0.5));  // which the device did not have
  CHECK(controller.theta_hat() == before);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(controller.update(11ms, is, wanted, {0, 0, 0}, own, One(nan)).status == Status::not_finite);
}

TEST_CASE("a torque that was not had is remembered over a call that is refused") {
  SlotineLiAdaptive<Pendulum<>> controller(pendulum_settings());
  const JointState<1> is{One(0.3), One(1.0)};
  const DesiredJoints<1> wanted{One(0.5), One(2.0), One(16.0)};
  const One nan(std::numeric_limits<double>::quiet_NaN());
  const One tau = controller.update(0ms, is, wanted, {0, 0, 0}, One(0.0)).tau;
  CHECK(controller.update(1ms, {nan, nan}, wanted, {0, 0, 0}, One(0.0)).status == Status::not_finite);
  CHECK(controller.update(2ms, is, wanted, {0, 0, 0}, nan).status == Status::not_finite);
  CHECK(controller.update(3ms, is, wanted, {0, 0, 0}, tau).tau == tau);
  CHECK(controller.theta_hat() == Eigen::Vector3d(0.5, 8.0, 0.25));
}

TEST_CASE("a latched fault of minutes winds nothing up, and after the reset the arm goes on as before") {
  const Vector<double> start(0, 0.8, -1.5);
  limpid::SimulatedOmni<> arm({.q0 = start});
  SlotineLiAdaptive<Omni<>> controller(thesis_settings<double>());
  limpid::SafetyLimiter<Omni<>> limiter({});
  const DesiredJoints<3> wanted{start + Vector<double>(0.1, 0.1, -0.1), {0, 0, 0}, {0, 0, 0}};
  Vector<double> torque(0, 0, 0);
  const auto tick = [&](Time now, Status upstream) {
    const auto is = arm.read(now).joint_state();
    const auto tau = controller.update(now, is, wanted, {0, 0, 0}, torque).tau;
    const auto safe = limiter.limit(now, is, tau, upstream);
    torque = safe.torque.value();
    return safe;
  };
  Time now = 0ms;
  for (; now < 100ms; now += 1ms) (void)tick(now, Status::ok);  // the arm stands: nobody moves it on
  (void)tick(now, Status::disconnected);
  const auto theta_hat = controller.theta_hat();
  now += 1ms;
  (void)tick(now, Status::ok);  // the interval before still had the wanted torque
  const auto latched = controller.theta_hat();
  CHECK((latched - theta_hat).cwiseAbs().maxCoeff() < 1e-4);
  for (const Time end = now + 120s; now < end;) {
    now += 1ms;
    REQUIRE(tick(now, Status::ok).torque.value() == Vector<double>::Zero());
  }
  CHECK(controller.theta_hat() == latched);
  limiter.reset(now);
  const Time reset = now;
  while (now < reset + 20ms) {
    now += 1ms;
    REQUIRE(!has(tick(now, Status::ok).status, Status::fault));
  }
  CHECK((controller.theta_hat() - latched).cwiseAbs().maxCoeff() < 1e-3);  // 20 ms of errors of 0.1 rad
}

TEST_CASE("an impossible rate moves no parameter and says so") {
  for (const double rate : {1e3, 1e20, 1e60, -1e60}) {
    CAPTURE(rate);
    SlotineLiAdaptive<Omni<>> controller(thesis_settings<double>());
    JointState<3> is{{0, 0.9, -1.3}, {0, 0, 0}};
    const DesiredJoints<3> wanted{{0.1, 0.9, -1.4}, {0, 0, 0}, {0, 0, 0}};
    (void)controller.update(0ms, is, wanted, {0, 0, 0});
    CHECK(controller.update(1ms, is, wanted, {0, 0, 0}).status == Status::ok);
    const auto theta_hat = controller.theta_hat();
    is.qdot[1] = rate;
    CHECK(controller.update(2ms, is, wanted, {0, 0, 0}).status == Status::at_bound);
    is.qdot[1] = 0;
    CHECK(controller.update(3ms, is, wanted, {0, 0, 0}).status == Status::at_bound);  // its mean with the last one
    CHECK(controller.theta_hat() == theta_hat);
    CHECK(controller.update(4ms, is, wanted, {0, 0, 0}).status == Status::ok);
    CHECK(controller.theta_hat() != theta_hat);
  }
}

TEST_CASE("a step that adds more to the Lyapunov function than the controller takes out is left out") {
  auto settings = pendulum_settings();
  settings.Gamma = {0, 1, 0};
  // at rest at q = pi/2, q_e' = 1: delta = -1, phi_r' delta = (., -1, .): h^2 / 2 against 2 h
  const double quarter = std::acos(0.0);
  settings.longest_step = 10s;
  for (const Time h : {Time{3900ms}, Time{4100ms}}) {
    SlotineLiAdaptive<Pendulum<>> controller(settings);
    const JointState<1> is{One(quarter), One(0.0)};
    const DesiredJoints<1> wanted{One(quarter), One(1.0), One(0.0)};
    (void)controller.update(0ms, is, wanted, {0, 0, 0});
    const Status status = controller.update(h, is, wanted, {0, 0, 0}).status;
    CHECK(status == (h < 4s ? Status::ok : Status::at_bound));
    CHECK(controller.theta_hat()[1] == doctest::Approx(h < 4s ? 11.9 : 8.0));
  }
}

TEST_CASE("an update does not allocate") {
  SlotineLiAdaptive<Omni<>> controller(thesis_settings<double>());
  const auto is = some_state(0.5);
  const auto wanted = some_target(0.5);
  limpid::test::check_no_allocation([&] {
    (void)controller.update(1ms, is, wanted, {1, 2, 3});
    (void)controller.update(2ms, is, wanted, {1, 2, 3});
    (void)controller.update(3ms, is, wanted, {1, 2, 3}, {0, 0, 0});
  });
}

TEST_CASE("settings that cannot serve are refused with their field") {
  using Controller = SlotineLiAdaptive<Pendulum<>>;
  CHECK_THROWS_WITH_AS(Controller({.Kd = One(2.0), .Gamma = {1, 1, 1}, .theta0 = {1, 1, 1}}),
                       "SlotineLiAdaptive: Lambda: expected finite and > 0, got nan", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Controller({.Lambda = One(4.0), .Gamma = {1, 1, 1}, .theta0 = {1, 1, 1}}),
                       "SlotineLiAdaptive: Kd: expected finite and > 0, got nan", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Controller({.Lambda = One(4.0), .Kd = One(2.0), .theta0 = {1, 1, 1}}),
                       "SlotineLiAdaptive: Gamma: expected finite and >= 0, got nan nan nan", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Controller({.Lambda = One(4.0), .Kd = One(2.0), .Gamma = {1, 1, 1}}),
                       "SlotineLiAdaptive: theta0: expected finite, got nan nan nan", std::invalid_argument);
  auto settings = pendulum_settings();
  settings.Lambda[0] = -1;
  CHECK_THROWS_WITH_AS(Controller{settings}, "SlotineLiAdaptive: Lambda: expected finite and > 0, got -1",
                       std::invalid_argument);
  settings = pendulum_settings();
  settings.Kd[0] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(Controller{settings}, "SlotineLiAdaptive: Kd: expected finite and > 0, got inf",
                       std::invalid_argument);
  settings = pendulum_settings();
  settings.Gamma[1] = -0.5;
  CHECK_THROWS_WITH_AS(Controller{settings}, "SlotineLiAdaptive: Gamma: expected finite and >= 0, got 0.5 -0.5 1",
                       std::invalid_argument);
  settings = pendulum_settings();
  settings.theta0[2] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(Controller{settings}, "SlotineLiAdaptive: theta0: expected finite, got 0.5 8 inf",
                       std::invalid_argument);
  settings = pendulum_settings();
  settings.lower[1] = 9;
  CHECK_THROWS_WITH_AS(Controller{settings}, "SlotineLiAdaptive: lower: expected <= theta0, got -inf 9 -inf",
                       std::invalid_argument);
  settings = pendulum_settings();
  settings.upper[1] = 7;
  CHECK_THROWS_WITH_AS(Controller{settings}, "SlotineLiAdaptive: upper: expected >= theta0, got inf 7 inf",
                       std::invalid_argument);
  settings = pendulum_settings();
  settings.longest_step = 0ms;
  CHECK_THROWS_WITH_AS(Controller{settings}, "SlotineLiAdaptive: longest_step: expected > 0 s, got 0 s",
                       std::invalid_argument);
}
