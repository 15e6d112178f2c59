// SPDX-License-Identifier: MIT
#include <limpid/device/simulated_omni.hpp>

#include <support/no_allocation.hpp>
#include <support/permit.hpp>

#include <Eigen/Cholesky>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>

using limpid::DormandPrince;
using limpid::Omni;
using limpid::OperatorCoupling;
using limpid::Realism;
using limpid::SimulatedOmni;
using limpid::Status;
using limpid::Time;
using limpid::test::permit;
using namespace std::chrono_literals;

namespace {

using Vector = Eigen::Vector3d;

const Vector none = Vector::Zero();
const Vector start{0.1, 0.8, -1.5};

auto safe(const Vector& torque) { return permit(Omni<>{}, torque); }

Eigen::Matrix<double, 9, 1> without_friction() {
  auto theta = Omni<>::table_5_2();
  theta.tail<3>().setZero();
  return theta;
}

}  // namespace

TEST_CASE("between ticks the ideal arm follows (3.15), solved in long double to 1e-16") {
  using Long = Eigen::Matrix<long double, 3, 1>;
  using State = Eigen::Matrix<long double, 6, 1>;
  const auto theta = Omni<long double>::table_5_2();
  const Vector torque(0.05, -0.1, 0.08), force(1, -2, 0.5);
  SimulatedOmni<> omni({.q0 = start});
  CHECK(omni.advance(0ms, force) == Status::ok);
  CHECK(omni.write(safe(torque)) == Status::ok);
  const Long held =
      torque.cast<long double>() +
      Omni<long double>{}.at(start.cast<long double>()).jacobian().transpose() * force.cast<long double>();
  State expected;
  expected << start.cast<long double>(), Long::Zero();
  const DormandPrince<State> reference({.absolute = 1e-18L, .relative = 1e-16L});
  REQUIRE(reference.advance(expected, 0.0L, 0.05L, [&](long double, const State& y) {
    const Long q = y.head<3>(), qdot = y.tail<3>();
    const auto arm = Omni<long double>{}.at(q);
    State slope;
    slope << qdot, arm.H(theta).llt().solve(held - (arm.C(theta, qdot) + arm.B(theta)) * qdot - arm.tau_g(theta));
    return slope;
  }) == Status::ok);
  CHECK(omni.advance(50ms, force) == Status::ok);
  const auto [q, qdot] = omni.true_state();
  CHECK((q - expected.head<3>().cast<double>()).cwiseAbs().maxCoeff() < 1e-9);     // ten steps of 1e-10
  CHECK((qdot - expected.tail<3>().cast<double>()).cwiseAbs().maxCoeff() < 1e-8);  // of rates of some 5 rad/s
}

TEST_CASE("an ideal arm without viscous friction keeps its energy as it falls") {
  const auto theta = without_friction();
  SimulatedOmni<> omni({.theta = theta, .q0 = start});
  const auto energy = [&] {
    const auto [q, qdot] = omni.true_state();
    const double kinetic = qdot.dot(Omni<>{}.at(q).H(theta) * qdot) / 2;
    return kinetic + 9.81 * (theta[4] * std::sin(q[1]) + theta[5] * std::sin(q[1] + q[2]));
  };
  (void)omni.advance(0ms, none);
  const double before = energy();
  for (int k = 1; k <= 500; ++k) REQUIRE(omni.advance(k * 1ms, none) == Status::ok);
  CHECK((omni.true_state().q - start).norm() > 0.5);  // it did fall
  CHECK(std::abs(energy() - before) < 1e-8);          // 500 steps of 1e-10 of energies below 0.2 J
}

TEST_CASE("the torque that holds the arm against gravity holds it") {
  SimulatedOmni<> omni({.q0 = start});
  (void)omni.advance(0ms, none);
  (void)omni.write(safe(Omni<>{}.at(start).tau_g(Omni<>::table_5_2())));
  for (int k = 1; k <= 1000; ++k) (void)omni.advance(k * 1ms, none);
  CHECK((omni.true_state().q - start).cwiseAbs().maxCoeff() < 1e-13);  // roundings of torques of 0.1 N m, for 1 s
}

TEST_CASE("on an ideal arm a controller's -J' F_h cancels the operator's force exactly") {
  SimulatedOmni<> pushed({.q0 = start}), free({.q0 = start});
  for (int k = 0; k <= 500; ++k) {
    const Vector F_h(3 * std::sin(0.02 * k), 2, -1.5 * std::cos(0.03 * k));
    (void)pushed.advance(k * 1ms, F_h);
    (void)free.advance(k * 1ms, none);
    const auto seen = pushed.read(k * 1ms);
    (void)pushed.write(safe(-Omni<>{}.at(seen.q).jacobian().transpose() * F_h));
  }
  CHECK(pushed.true_state().q == free.true_state().q);
  CHECK(pushed.true_state().qdot == free.true_state().qdot);
}

TEST_CASE("in playback the operator's force does not act on the arm") {
  for (const Realism realism : {Realism::ideal, Realism::realistic}) {
    SimulatedOmni<> played({.q0 = start, .realism = realism, .coupling = OperatorCoupling::playback});
    SimulatedOmni<> free({.q0 = start, .realism = realism});
    for (int k = 0; k <= 50; ++k) {
      (void)played.advance(k * 1ms, {3, -2, 1});
      (void)free.advance(k * 1ms, none);
    }
    CHECK(played.true_state().q == free.true_state().q);
  }
}

TEST_CASE("on a realistic arm the force is linear between ticks: a tick in two halves is the same") {
  SimulatedOmni<> whole({.q0 = start, .realism = Realism::realistic});
  SimulatedOmni<> halves({.q0 = start, .realism = Realism::realistic});
  (void)whole.advance(0ms, {1, 2, -3});
  (void)halves.advance(0ms, {1, 2, -3});
  (void)whole.advance(20ms, {-2, 0, 5});
  (void)halves.advance(10ms, {-0.5, 1, 1});
  (void)halves.advance(20ms, {-2, 0, 5});
  CHECK((whole.true_state().q - start).norm() > 1e-3);
  CHECK((whole.true_state().q - halves.true_state().q).norm() < 1e-9);  // ten steps of 1e-10
}

TEST_CASE("below static friction a joint only bends, as Dahl's law says, and springs back") {
  // quasi-static loading: dz/dq = 1 - z/z_s, so q = -z_s ln(1 - tau/f_s); half of f_s bends by z_s ln 2
  SimulatedOmni<> omni({.q0 = start, .realism = Realism::realistic});
  const Vector hold = Omni<>{}.at(start).tau_g(Omni<>::table_5_2());
  (void)omni.advance(0ms, none);
  for (int k = 1; k <= 2000; ++k) {
    (void)omni.write(safe(hold + Vector(0.065 / 2 * k / 2000, 0, 0)));
    (void)omni.advance(k * 1ms, none);
  }
  const double bent = omni.true_state().q[0] - start[0];
  CHECK(bent == doctest::Approx(5e-4 * std::log(2.0)).epsilon(0.01));  // viscous lag b q'/f_s, 1e-4 / s: below 0.1 %
  // unloading: dz/dq = 1 + z/z_s, from z_s/2 to 0: q falls by z_s ln(3/2)
  for (int k = 2001; k <= 4000; ++k) {
    (void)omni.write(safe(hold + Vector(0.065 / 2 * (4000 - k) / 2000, 0, 0)));
    (void)omni.advance(k * 1ms, none);
  }
  CHECK(bent - (omni.true_state().q[0] - start[0]) == doctest::Approx(5e-4 * std::log(1.5)).epsilon(0.01));
}

TEST_CASE("a sliding joint is braked by its static friction beside the viscous one") {
  // joint 1 alone under 0.2 N m, the others held: b1 q1' = 0.2 - 0.065 where it has settled (time constant 0.1 s)
  SimulatedOmni<> omni({.q0 = start, .realism = Realism::realistic});
  const auto theta = Omni<>::table_5_2();
  (void)omni.advance(0ms, none);
  for (int k = 1; k <= 1500; ++k) {
    const auto [q, qdot] = omni.true_state();
    const auto arm = Omni<>{}.at(q);
    Vector hold = arm.tau_g(theta) + arm.C(theta, qdot) * qdot - Vector(0, 20, 20).cwiseProduct(q - start) -
                  Vector(0, 0.5, 0.5).cwiseProduct(qdot);
    hold[0] = 0.2;
    (void)omni.write(safe(hold));
    (void)omni.advance(k * 1ms, none);
  }
  CHECK(omni.true_state().qdot[0] == doctest::Approx((0.2 - 0.065) / 0.096).epsilon(1e-3));  // the others move a little
}

TEST_CASE("the realistic motors saturate at Table 5.1, and say so") {
  SimulatedOmni<> asked({.q0 = start, .realism = Realism::realistic});
  SimulatedOmni<> given({.q0 = start, .realism = Realism::realistic});
  (void)asked.advance(0ms, none);
  (void)given.advance(0ms, none);
  CHECK(asked.write(safe({1, -1, 0.1})) == Status::limited);
  CHECK(given.write(safe({0.30, -0.29, 0.1})) == Status::ok);
  (void)asked.advance(10ms, none);
  (void)given.advance(10ms, none);
  CHECK(asked.true_state().q == given.true_state().q);
  SimulatedOmni<> ideal({});
  CHECK(ideal.write(safe({1, -1, 0.1})) == Status::ok);
}

TEST_CASE("realistic angles come in steps of 4e-4 rad, and rates through the 4 Hz filter from them") {
  SimulatedOmni<> omni({.q0 = start, .realism = Realism::realistic});
  limpid::FilteredDerivative<3> filter({.time_constant = 0.0398});
  (void)omni.write(safe({0.2, 0.2, -0.1}));
  for (int k = 0; k <= 100; ++k) {
    (void)omni.advance(k * 1ms, none);
    const auto seen = omni.read(k * 1ms);
    const Vector steps = seen.q / 4e-4;
    CHECK((steps.array() - steps.array().round()).abs().maxCoeff() < 1e-12);           // a division of 1e4 steps
    CHECK((seen.q - omni.true_state().q).cwiseAbs().maxCoeff() < 2e-4 * (1 + 1e-12));  // half a step
    CHECK((seen.qdot.array() == filter.update(k * 1ms, seen.q.array()).value).all());
  }
}

TEST_CASE("an ideal arm shows its state as it is") {
  SimulatedOmni<> omni({.q0 = start});
  for (int k = 0; k <= 20; ++k) (void)omni.advance(k * 1ms, {1, 1, 1});
  CHECK(omni.read(20ms).q == omni.true_state().q);
  CHECK(omni.read(20ms).qdot == omni.true_state().qdot);
  CHECK(omni.read(20ms).stamp == 20ms);
  CHECK(omni.read(20ms).status == Status::ok);
}

TEST_CASE("before the first advance there is no sample; a reading from another instant is stale") {
  SimulatedOmni<> omni({.q0 = start});
  CHECK(omni.read(0ms).status == Status::no_sample);
  CHECK(omni.read(0ms).q == start);
  (void)omni.advance(3ms, none);
  CHECK(omni.read(3ms).status == Status::ok);
  CHECK(omni.read(4ms).status == Status::stale);
}

TEST_CASE("pulling the plug takes the torque away, and plugging in again does not bring it back") {
  SimulatedOmni<> pulled({.theta = without_friction(), .q0 = start});
  SimulatedOmni<> free({.theta = without_friction(), .q0 = start});
  (void)pulled.advance(0ms, none);
  (void)free.advance(0ms, none);
  (void)pulled.write(safe({0.3, 0.3, 0.3}));
  pulled.disconnect();
  CHECK(pulled.write(safe({0.3, 0.3, 0.3})) == Status::disconnected);
  (void)pulled.advance(10ms, none);
  CHECK(has(pulled.read(10ms).status, Status::disconnected));
  CHECK(pulled.read(10ms).q == start);  // the last known
  pulled.reconnect();
  (void)pulled.advance(20ms, none);
  (void)free.advance(10ms, none);
  (void)free.advance(20ms, none);
  CHECK(pulled.true_state().q == free.true_state().q);
  CHECK(pulled.read(20ms).status == Status::ok);
}

TEST_CASE("time that does not advance and a force that is not finite move nothing") {
  for (const Realism realism : {Realism::ideal, Realism::realistic}) {
    SimulatedOmni<> omni({.q0 = start, .realism = realism}), twin({.q0 = start, .realism = realism});
    (void)omni.advance(1ms, {1, 2, 3});
    (void)twin.advance(1ms, {1, 2, 3});
    CHECK(omni.advance(1ms, {9, 9, 9}) == Status::clock_backwards);
    CHECK(omni.advance(0ms, {9, 9, 9}) == Status::clock_backwards);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()}) {
      for (int i = 0; i < 3; ++i) {
        Vector F_h(1, 2, 3);
        F_h[i] = bad;
        CHECK(omni.advance(2ms, F_h) == Status::not_finite);
      }
    }
    if (realism == Realism::realistic) CHECK(omni.advance(2ms, {1e300, 0, 0}) != Status::ok);  // beyond following
    CHECK(omni.true_state().q == twin.true_state().q);
    (void)omni.advance(3ms, {1, 2, 3});
    (void)twin.advance(3ms, {1, 2, 3});
    CHECK(omni.true_state().q == twin.true_state().q);
    CHECK(omni.read(3ms).qdot == twin.read(3ms).qdot);
  }
}

TEST_CASE("no call of the device's face allocates") {
  for (const Realism realism : {Realism::ideal, Realism::realistic}) {
    SimulatedOmni<> omni({.q0 = start, .realism = realism});
    const auto torque = safe({0.1, 0.1, 0.1});
    limpid::test::check_no_allocation([&] {
      for (int k = 0; k < 5; ++k) {
        (void)omni.advance(k * 1ms, {1, 1, 1});
        (void)omni.read(k * 1ms);
        (void)omni.write(torque);
      }
    });
  }
}

TEST_CASE("settings that cannot serve are refused with their field") {
  CHECK_THROWS_WITH_AS(SimulatedOmni<>({.q0 = {0, std::numeric_limits<double>::infinity(), 0}}),
                       "SimulatedOmni: q0: expected finite, got 0 inf 0", std::invalid_argument);
  auto theta = Omni<>::table_5_2();
  theta[8] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(SimulatedOmni<>({.theta = theta}), std::invalid_argument);
  theta.setConstant(-1);
  CHECK_THROWS_WITH_AS(
      SimulatedOmni<>({.theta = theta}),
      "SimulatedOmni: theta: expected with a positive definite H at q0, got -1 -1 -1 -1 -1 -1 -1 -1 -1",
      std::invalid_argument);
}
