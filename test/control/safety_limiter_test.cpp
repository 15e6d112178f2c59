// SPDX-License-Identifier: MIT
#include <limpid/control/safety_limiter.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/robot/serial_chain.hpp>

#include <support/no_allocation.hpp>
#include <support/pendulum.hpp>

#include <Eigen/LU>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

using limpid::FaultReason;
using limpid::JointState;
using limpid::Omni;
using limpid::SafetyLimiter;
using limpid::Status;
using limpid::Time;
using limpid::test::Pendulum;
using namespace std::chrono_literals;

namespace {

using Vector = Eigen::Vector3d;
using Limiter = SafetyLimiter<Omni<>>;

const JointState<3> free_pose{{0.1, 0.7, -1.4}, {0, 0, 0}};  // 0.15 rad and 15 mm clear of every limit

// A limiter that has worked up to `torque`, 100 ticks of 1 ms.
Limiter at_work(const Vector& torque) {
  Limiter limiter({});
  for (int k = 0; k < 100; ++k) (void)limiter.limit(k * 1ms, free_pose, torque);
  REQUIRE(limiter.limit(100ms, free_pose, torque).torque.value() == torque);
  return limiter;
}

}  // namespace

TEST_CASE("the first call gives zero torque and starts the clock") {
  Limiter limiter({});
  const auto [torque, status] = limiter.limit(5ms, free_pose, {0.1, 0.1, 0.1});
  CHECK(torque.value() == Vector::Zero());
  CHECK(status == Status::limited);
}

TEST_CASE("a torque within all limits passes untouched") {
  CHECK(at_work({0.1, -0.2, 0.1}).reason() == FaultReason::none);
}

TEST_CASE("no more than the limits of Table 5.1 over 1.3 passes") {
  Limiter limiter({});
  for (int k = 0; k < 100; ++k) (void)limiter.limit(k * 1ms, free_pose, {9, -9, 9});
  const auto [torque, status] = limiter.limit(100ms, free_pose, {9, -9, 9});
  CHECK(status == Status::limited);
  CHECK(torque.value().isApprox(Vector(0.30, -0.29, 0.20) / 1.3, 1e-15));  // a division's rounding
}

TEST_CASE("torque rises straight toward what is wanted, at the slew rate of its slowest joint") {
  Limiter limiter({.slew = Vector(10, 1, 100)});
  (void)limiter.limit(0ms, free_pose, {0.1, 0.1, 0.1});
  for (int k = 1; k <= 50; ++k) {  // joint 2 needs 100 ms for 0.1 N m, and the others wait for it
    const Vector torque = limiter.limit(k * 1ms, free_pose, {0.1, 0.1, 0.05}).torque.value();
    CHECK(torque.isApprox(Vector(1, 1, 0.5) * 0.001 * k, 1e-13));  // k roundings
  }
}

TEST_CASE("a torque toward a limit that has come near goes at once, whatever the slew rate") {
  Limiter limiter = at_work({0.2, 0.1, 0.1});
  JointState<3> near = free_pose;
  near.q[0] = 1.0;  // 0.047 rad from pi/3
  const auto [torque, status] = limiter.limit(101ms, near, {0.2, 0.1, 0.1});
  CHECK(torque.value() == Vector(0, 0.1, 0.1));
  CHECK(status == Status::joint_limit);
}

TEST_CASE("torque away from a near limit passes") {
  Limiter limiter({});
  JointState<3> near = free_pose;
  near.q[0] = 1.0;
  for (int k = 0; k < 100; ++k) (void)limiter.limit(k * 1ms, near, {-0.2, 0, 0});
  CHECK(limiter.limit(100ms, near, {-0.2, 0, 0}).torque.value() == Vector(-0.2, 0, 0));
}

TEST_CASE("over the band before its margin a rule lets less and less torque pass, and without a band all of it") {
  for (const double clear : {0.05, 0.04, 0.025, 0.01}) {
    CAPTURE(clear);
    Limiter limiter({}), sudden({.joint_band = 0});
    JointState<3> near = free_pose;
    near.q[0] = limpid::Omni<>{}.limits().upper[0] - 0.1 - clear;
    for (int k = 0; k < 100; ++k) {
      (void)limiter.limit(k * 1ms, near, {9, 0.1, 0.1});
      (void)sudden.limit(k * 1ms, near, {9, 0.1, 0.1});
    }
    const auto [torque, status] = limiter.limit(100ms, near, {9, 0.1, 0.1});
    CHECK(torque.value()[0] == doctest::Approx(0.30 / 1.3 * clear / 0.05).epsilon(1e-13));  // roundings of q
    CHECK(torque.value().tail<2>() == Eigen::Vector2d(0.1, 0.1));
    CHECK(status == (clear < 0.05 ? Status::joint_limit : Status::limited));
    CHECK(sudden.limit(100ms, near, {9, 0.1, 0.1}).torque.value()[0] == doctest::Approx(0.30 / 1.3).epsilon(1e-15));
  }
}

TEST_CASE("near the base the tip is not pressed toward it, and what else the hand feels stays") {
  const Vector q(0.2, 1.2, -1.95);  // r = 0.144 m: 0.049 + 0.095; see below
  const auto pose = Omni<>{}.at(q);
  const double radius = pose.position().head<2>().norm();
  const Vector outward(std::cos(0.2), std::sin(0.2), 0);
  // F_h at the tip by J' F = tau, eq. (3.7)'s dual, with no formula of the limiter's
  const auto force = [&](const Vector& tau) { return Vector(pose.jacobian().transpose().partialPivLu().solve(tau)); };
  Limiter limiter({.workspace_margin = radius - 0.12 + 0.001});
  const Vector inward = pose.jacobian().transpose() * Vector(-0.5 * outward + Vector(0, 0, 0.3));
  const Vector away = pose.jacobian().transpose() * Vector(0.5 * outward + Vector(0, 0, 0.3));
  for (int k = 0; k < 100; ++k) (void)limiter.limit(k * 1ms, {q, Vector::Zero()}, inward);
  const auto held = limiter.limit(100ms, {q, Vector::Zero()}, inward);
  CHECK(force(inward).dot(outward) == doctest::Approx(-0.5));
  CHECK(std::abs(force(held.torque.value()).dot(outward)) < 1e-12);  // roundings of 0.2 N m over 5 mm of det J / r
  CHECK(held.status == Status::workspace_limit);
  for (int k = 101; k < 200; ++k) (void)limiter.limit(k * 1ms, {q, Vector::Zero()}, away);
  CHECK(limiter.limit(200ms, {q, Vector::Zero()}, away).torque.value() == away);
}

TEST_CASE("what a rule adds to a joint comes at the slew rate") {
  Limiter limiter({.slew = Vector(1, 1, 1)});
  const JointState<3> before{{0, 0.9, -1.6}, {0, 0, 0}};
  for (int k = 0; k < 500; ++k) (void)limiter.limit(k * 1ms, before, {0, 0.2, 0});
  REQUIRE(limiter.limit(500ms, before, {0, 0.2, 0}).torque.value() == Vector(0, 0.2, 0));
  const JointState<3> behind{{0, 1.2, -2.1},
                             {0, 0, 0}};  // r = 0.13: the nearest torque that presses outward has tau3 > 0
  const Vector torque = limiter.limit(501ms, behind, {0, 0.2, 0}).torque.value();
  CHECK(torque[2] > 0);
  CHECK(torque[2] <= 0.001 + 1e-16);  // N m/s for a millisecond
  CHECK(torque[1] < 0.2);
}

TEST_CASE("near (5.4) neither joint 2 nor joint 3 is pushed further") {
  Limiter limiter = at_work({0.1, 0.1, 0.1});
  const auto [torque, status] = limiter.limit(101ms, {{0, 1.2, -1.085}, {0, 0, 0}}, {0.1, 0.1, 0.1});  // sum 0.115
  CHECK(torque.value() == Vector(0.1, 0, 0));
  CHECK(status == Status::joint_limit);
}

TEST_CASE("the workspace is watched unless it is switched off") {
  const JointState<3> stretched{{0, 0.3, -0.41}, {0, 0, 0}};  // |x| = 0.2594; joint 3 0.16 rad from its limit
  for (const bool watched : {true, false}) {
    Limiter limiter({.workspace = watched});
    for (int k = 0; k < 100; ++k) (void)limiter.limit(k * 1ms, stretched, {0, -0.1, 0.1});
    const auto [torque, status] = limiter.limit(100ms, stretched, {0, -0.1, 0.1});
    CHECK(torque.value()[2] == (watched ? 0.0 : 0.1));
    CHECK(status == (watched ? Status::workspace_limit : Status::ok));
  }
}

TEST_CASE("every fault gives zero torque in the same call, and until reset") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  struct Case {
    const char* name;
    FaultReason reason;
    Time now = 101ms;
    JointState<3> is = free_pose;
    Vector wanted{0.1, 0.1, 0.1};
    Status upstream = Status::ok;
  };
  std::vector<Case> cases{
      {.name = "clock stands", .reason = FaultReason::clock_backwards, .now = 100ms},
      {.name = "clock goes back", .reason = FaultReason::clock_backwards, .now = 50ms},
      {.name = "clock leaps", .reason = FaultReason::gap_too_long, .now = 121ms},
      {.name = "disconnected", .reason = FaultReason::disconnected, .upstream = Status::disconnected},
      {.name = "fault before", .reason = FaultReason::upstream, .upstream = Status::fault | Status::singular},
      {.name = "input not finite before", .reason = FaultReason::upstream, .upstream = Status::not_finite},
      {.name = "stale", .reason = FaultReason::upstream, .upstream = Status::stale},
  };
  for (int i = 0; i < 3; ++i) {
    for (const double bad : {nan, inf, -inf}) {
      Case c{.name = "angle", .reason = FaultReason::state_not_finite};
      c.is.q[i] = bad;
      cases.push_back(c);
      c = {.name = "rate", .reason = FaultReason::state_not_finite};
      c.is.qdot[i] = bad;
      cases.push_back(c);
      c = {.name = "torque", .reason = FaultReason::torque_not_finite};
      c.wanted[i] = bad;
      cases.push_back(c);
    }
    for (const double far : {4.0, -4.0}) {
      Case c{.name = "joint", .reason = FaultReason::joint_out_of_range};
      c.is.q[i] = far;
      cases.push_back(c);
    }
  }
  for (const Case& c : cases) {
    CAPTURE(c.name);
    Limiter limiter = at_work({0.2, -0.2, 0.1});
    const auto [torque, status] = limiter.limit(c.now, c.is, c.wanted, c.upstream);
    CHECK(torque.value() == Vector::Zero());
    CHECK(status == Status::fault);
    CHECK(limiter.reason() == c.reason);
    const auto later = limiter.limit(102ms, free_pose, {0.1, 0.1, 0.1});  // all is well again, and yet
    CHECK(later.torque.value() == Vector::Zero());
    CHECK(later.status == Status::fault);
    CHECK(limiter.reason() == c.reason);
  }
}

TEST_CASE("a reset ends a fault and starts again from zero torque") {
  Limiter limiter = at_work({0.2, 0.2, 0.1});
  (void)limiter.limit(200ms, free_pose, {0.2, 0.2, 0.1});
  CHECK(limiter.reason() == FaultReason::gap_too_long);
  limiter.reset(300ms);
  CHECK(limiter.reason() == FaultReason::none);
  const auto [torque, status] = limiter.limit(301ms, free_pose, {0.2, 0.2, 0.1});
  CHECK(status == Status::limited);
  CHECK(torque.value().isApprox(Vector(0.2, 0.2, 0.1) * (0.29 / 1.3 * 100 * 0.001) / 0.2, 1e-14));  // joint 2's slew
}

TEST_CASE("a fault that is still there after a reset stops it again") {
  Limiter limiter = at_work({0.2, 0.2, 0.1});
  (void)limiter.limit(101ms, free_pose, {0, 0, 0}, Status::disconnected);
  limiter.reset(102ms);
  const auto [torque, status] = limiter.limit(103ms, free_pose, {0.2, 0.2, 0.1}, Status::disconnected);
  CHECK(status == Status::fault);
  CHECK(torque.value() == Vector::Zero());
}

TEST_CASE("a reset may be followed by a call at the same instant, which gives zero torque") {
  Limiter limiter = at_work({0.2, 0.2, 0.1});
  (void)limiter.limit(200ms, free_pose, {0.2, 0.2, 0.1});
  limiter.reset(300ms);
  CHECK(limiter.limit(300ms, free_pose, {0.2, 0.2, 0.1}).torque.value() == Vector::Zero());
  CHECK(limiter.reason() == FaultReason::none);
}

TEST_CASE("a reset without a fault changes nothing") {
  Limiter limiter = at_work({0.1, 0.1, 0.1}), undisturbed = at_work({0.1, 0.1, 0.1});
  limiter.reset(101ms);
  CHECK(limiter.limit(102ms, free_pose, {0.1, 0.1, 0.1}).torque.value() ==
        undisturbed.limit(102ms, free_pose, {0.1, 0.1, 0.1}).torque.value());
}

TEST_CASE("a leap of the clock over all of its range is a gap, not a negative step") {
  Limiter limiter({});
  (void)limiter.limit(limpid::Time::min() + 1ms, free_pose, {0.01, 0.01, 0.01});
  const auto [torque, status] = limiter.limit(limpid::Time::max(), free_pose, {0.01, 0.01, 0.01});
  CHECK(torque.value() == Vector::Zero());
  CHECK(status == Status::fault);
  CHECK(limiter.reason() == FaultReason::gap_too_long);
}

TEST_CASE("which upstream bits are a fault is a setting, and the others pass") {
  Limiter tolerant({.upstream_faults = Status::fault});
  (void)tolerant.limit(0ms, free_pose, {0, 0, 0});
  CHECK(tolerant.limit(1ms, free_pose, {0, 0, 0}, Status::not_finite | Status::disconnected).status == Status::ok);
  Limiter usual({});
  (void)usual.limit(0ms, free_pose, {0, 0, 0});
  CHECK(usual.limit(1ms, free_pose, {0, 0, 0}, Status::singular | Status::limited | Status::no_sample).status ==
        Status::ok);
}

TEST_CASE("any robot can be limited; without rules of its own, by its joints") {
  using One = Eigen::Matrix<double, 1, 1>;
  SafetyLimiter<Pendulum<>> limiter({.safety_factor = 2.0});
  (void)limiter.limit(0ms, {One(0.0), One(0.0)}, One(0.5));
  for (int k = 1; k < 20; ++k) (void)limiter.limit(k * 1ms, {One(0.0), One(0.0)}, One(5.0));
  CHECK(limiter.limit(20ms, {One(0.0), One(0.0)}, One(5.0)).torque.value()[0] == 1.0);
  CHECK(limiter.limit(21ms, {One(0.95), One(0.0)}, One(5.0)).torque.value()[0] == 0.0);
}

TEST_CASE("a joint with a limit on one side only is watched on that side") {
  using Chain = limpid::SerialChain<1>;
  using One = Chain::Joints;
  const double infinity = std::numeric_limits<double>::infinity();
  const One torque(0.1);
  for (const double side : {-1.0, 1.0}) {
    Chain::Settings chain{.links = {}};
    chain.limits = {.lower = One(side < 0 ? -1 : -infinity),
                    .upper = One(side > 0 ? 1 : infinity),
                    .torque = One(1.0),
                    .static_friction = One(0.0)};
    SafetyLimiter<Chain> limiter({.robot = Chain(chain)});
    (void)limiter.limit(0ms, {One(0.0), One(0.0)}, torque);
    CHECK_FALSE(has(limiter.limit(1ms, {One(-50 * side), One(0.0)}, torque).status, Status::fault));
    CHECK_FALSE(has(limiter.limit(2ms, {One(1.05 * side), One(0.0)}, torque).status, Status::fault));
    const auto result = limiter.limit(3ms, {One(50 * side), One(0.0)}, torque);
    CHECK(result.status == Status::fault);
    CHECK(result.torque.value()[0] == 0);
    CHECK(limiter.reason() == FaultReason::joint_out_of_range);
  }
}

TEST_CASE("every reason has a sentence") {
  for (int i = 0; i <= static_cast<int>(FaultReason::upstream); ++i) {
    CHECK(limpid::describe(static_cast<FaultReason>(i)) != "unknown");
  }
}

TEST_CASE("no call allocates, with or without a fault") {
  Limiter limiter({});
  limpid::test::check_no_allocation([&] {
    (void)limiter.limit(0ms, free_pose, {9, 9, 9});
    (void)limiter.limit(1ms, {{0, 0.02, -2.4}, {0, 0, 0}}, {9, -9, -9});
    (void)limiter.limit(0ms, free_pose, {9, 9, 9});
    limiter.reset(2ms);
  });
}

TEST_CASE("settings that cannot serve are refused with their field") {
  CHECK_THROWS_WITH_AS(Limiter({.safety_factor = 0.9}),
                       "SafetyLimiter: safety_factor: expected finite and >= 1, got 0.9", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Limiter({.torque_limit = Vector(1, 0, 1)}),
                       "SafetyLimiter: torque_limit: expected finite and > 0, got 1 0 1", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Limiter({.slew = Vector(1, 1, -1)}), "SafetyLimiter: slew: expected finite and > 0, got 1 1 -1",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Limiter({.joint_margin = -0.5}),
                       "SafetyLimiter: joint_margin: expected finite and >= 0, got -0.5", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Limiter({.joint_band = -0.5}), "SafetyLimiter: joint_band: expected finite and >= 0, got -0.5",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Limiter({.workspace_band = -0.5}),
                       "SafetyLimiter: workspace_band: expected finite and >= 0, got -0.5", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Limiter({.workspace_margin = -0.5}),
                       "SafetyLimiter: workspace_margin: expected finite and >= 0, got -0.5", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Limiter({.joint_overshoot = -0.5}),
                       "SafetyLimiter: joint_overshoot: expected finite and >= 0, got -0.5", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Limiter({.longest_gap = 0ms}), "SafetyLimiter: longest_gap: expected > 0 s, got 0 s",
                       std::invalid_argument);
  // where the slew rate follows from the others it is not to blame
  CHECK_THROWS_WITH_AS(Limiter({.torque_limit = Vector(1, 4e307, 1)}),
                       "SafetyLimiter: torque_limit: expected small enough for its slew in 10 ms, got 1 4e+307 1",
                       std::invalid_argument);
  CHECK_NOTHROW(Limiter({.torque_limit = Vector(1, 4e307, 1), .slew = Vector(1, 1, 1)}));
  CHECK_THROWS_WITH_AS(Limiter({.safety_factor = 1e308, .torque_limit = Vector(1e-20, 1, 1)}),
                       "SafetyLimiter: safety_factor: expected small enough for torque_limit over it, got 1e+308",
                       std::invalid_argument);
}
