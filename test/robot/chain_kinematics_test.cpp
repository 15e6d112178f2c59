// SPDX-License-Identifier: MIT
#include <limpid/robot/chain_kinematics.hpp>
#include <limpid/robot/inverse_kinematics.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>
#include <limpid/robot/serial_chain.hpp>

#include "chains.hpp"
#include "conformance/inverse_kinematics_suite.hpp"
#include "omni_states.hpp"
#include "worst.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

using Eigen::Vector3d;
using limpid::ChainKinematics, limpid::has, limpid::InverseKinematics, limpid::Omni, limpid::OmniKinematics,
    limpid::SerialChain, limpid::Status;
using limpid::test::OmniStates, limpid::test::puma_560, limpid::test::puma_560_settings, limpid::test::RandomChains,
    limpid::test::Worst;

static_assert(InverseKinematics<ChainKinematics<3>> && InverseKinematics<ChainKinematics<7, float>>);

namespace {

constexpr double quarter = std::numbers::pi / 2;
constexpr double infinity = std::numeric_limits<double>::infinity();

SerialChain<3> omni_chain() {
  return SerialChain<3>({.links = {{{.alpha = 0}, {.alpha = quarter}, {.a = 0.135}}},
                         .tip = Vector3d(0.130, 0, 0),
                         .limits = Omni<>().limits()});
}

using Six = Eigen::Matrix<double, 6, 1>;

}  // namespace

TEST_CASE("ChainKinematics keeps the laws of InverseKinematics") {
  limpid::test::check_inverse_kinematics(ChainKinematics<3>(omni_chain()), omni_chain(), Vector3d(0.1, 0.8, -1.25));
}

TEST_CASE("it finds the Omni's joints of the closed form") {
  OmniStates random(31);
  const ChainKinematics<3> iterative(omni_chain());
  const OmniKinematics<> closed{Omni<>()};
  Worst joints, rates;
  for (int i = 0; i < 3000; ++i) {
    const auto is = random();
    const auto pose = Omni<>().at(is.q);
    const Vector3d x = pose.position(), v = pose.jacobian() * is.qdot;
    const auto expected = closed.inverse(x, v, Vector3d::Zero()),
               actual = iterative.inverse(x, v, Vector3d::Zero(), {0.0, 0.9, -1.3});
    CHECK(actual.status == Status::ok);
    joints.see(actual.q - expected.q, i);
    rates.see(actual.qdot - expected.qdot, i);
  }
  CAPTURE(joints);
  CAPTURE(rates);
  CHECK(joints.error() < 1e-12);  // 32 roundings of 0.265 m over J's smallest singular value, above 0.004 m
  CHECK(rates.error() < 1e-10);   // rates up to 5 rad/s, times J's slope over that value
}

TEST_CASE("a redundant arm meets position, velocity and acceleration, and moves its joints no more than it must") {
  RandomChains random(32);
  const auto robot = puma_560();
  const ChainKinematics<6> kinematics(robot);
  Worst position, velocity, acceleration;
  int singular = 0;
  for (int i = 0; i < 2000; ++i) {
    const Six q = random.joints<6>(-1.5, 1.5), near = q + random.joints<6>(-0.2, 0.2);
    const Vector3d x = robot.at(q).position(), v = random.point(), a = 10 * random.point();
    const auto motion = kinematics.inverse(x, v, a, near);
    ++singular;
    if (has(motion.status, Status::singular)) continue;
    --singular;
    CHECK(motion.status == Status::ok);
    const auto pose = robot.at(motion.q);
    position.see((pose.position() - x).norm(), i);
    velocity.see((pose.jacobian() * motion.qdot - v).norm(), i);
    acceleration.see((pose.jacobian() * motion.qddot + pose.jacobian_dot(motion.qdot) * motion.qdot - a).norm(), i);
    CHECK((motion.q - near).norm() < 2 * (q - near).norm());
  }
  CAPTURE(position);
  CAPTURE(velocity);
  CAPTURE(acceleration);
  CHECK(singular < 20);
  CHECK(position.error() < 1e-13);      // 32 roundings of its reach
  CHECK(velocity.error() < 1e-13);      // roundings of v times a condition of J below 256
  CHECK(acceleration.error() < 1e-11);  // of accelerations up to 256^2 |v|^2 / reach in single joints
}

TEST_CASE("at a target that is its own pose the joints are left alone") {
  RandomChains random(33);
  const auto robot = puma_560();
  const Six q = random.joints<6>(-1, 1);
  CHECK(ChainKinematics<6>(robot).inverse(robot.at(q).position(), q).q == q);
}

TEST_CASE("wherever the target, joints stay within the limits, rates bounded, and what was not met is said") {
  RandomChains random(34);
  const ChainKinematics<3> kinematics(omni_chain());
  const auto limits = omni_chain().limits();
  const double edge = 0.265 / 256;
  int unreachable = 0;
  for (int i = 0; i < 3000; ++i) {
    CAPTURE(i);
    const Vector3d x = random.point(), v = random.point(), near = random.joints<3>(-2, 2);
    const auto motion = kinematics.inverse(x, v, Vector3d::Zero(), near);
    CHECK((motion.q.array() >= limits.lower.array()).all());
    CHECK((motion.q.array() <= limits.upper.array()).all());
    CHECK(motion.qdot.norm() <= v.norm() / edge * (1 + 1e-12));
    CHECK(motion.qddot.allFinite());
    const bool met = (omni_chain().at(motion.q).position() - x).norm() < 1e-14;
    CHECK(has(motion.status, Status::unreachable) == !met);
    unreachable += met ? 0 : 1;
    if (met && motion.status == Status::ok) {
      for (int j = 0; j < 3; ++j) {  // nothing moves out of its limits
        if (motion.q[j] == limits.upper[j]) CHECK(motion.qdot[j] <= 0);
        if (motion.q[j] == limits.lower[j]) CHECK(motion.qdot[j] >= 0);
      }
    }
  }
  CHECK(unreachable > 2000);  // of a cube of 1 m about an arm of 0.265 m
}

TEST_CASE("a redundant arm with joints at their limits meets the target and its motion with the others, or says so") {
  RandomChains random(35);
  auto settings = puma_560_settings();
  settings.limits.lower = Six::Constant(-0.3);
  settings.limits.upper = Six::Constant(0.3);
  const SerialChain<6> robot(settings);
  const ChainKinematics<6> kinematics(robot);
  int met = 0, at_limit = 0;
  for (int i = 0; i < 2000; ++i) {
    CAPTURE(i);
    const Vector3d x = robot.at(random.joints<6>(-0.35, 0.35)).position(), v = random.point();
    const auto motion = kinematics.inverse(x, v, Vector3d::Zero(), random.joints<6>(-0.3, 0.3));
    const auto pose = robot.at(motion.q);
    CHECK(motion.q.lpNorm<Eigen::Infinity>() <= 0.3);
    if (motion.status != Status::ok) continue;
    ++met;
    CHECK((pose.position() - x).norm() < 1e-13);
    CHECK((pose.jacobian() * motion.qdot - v).norm() < 1e-12);
    for (int j = 0; j < 6; ++j) {
      if (std::abs(motion.q[j]) < 0.3) continue;
      ++at_limit;
      CHECK(motion.q[j] * motion.qdot[j] <= 0);
    }
  }
  CHECK(met > 1000);
  CHECK(at_limit > 100);
}

TEST_CASE("a target beyond the reach, however far, stretches the arm toward it") {
  const SerialChain<3> robot(
      {.links = {{{.alpha = 0}, {.alpha = quarter}, {.a = 0.135}}}, .tip = Vector3d(0.13, 0, 0)});
  const ChainKinematics<3> kinematics(robot);
  const Vector3d direction = Vector3d(3, -2, 6) / 7;
  for (const double distance : {0.3, 1.0, 1e10, 1e300}) {
    const auto motion = kinematics.inverse(distance * direction, {1, 2, 3}, {1, 2, 3}, {0.1, 0.2, -0.3});
    CHECK((robot.at(motion.q).position() - 0.265 * direction).norm() < 1e-7);  // of the second order near the border
    CHECK(motion.status == (Status::unreachable | Status::singular));
    CHECK(motion.qdot.norm() <= Vector3d(1, 2, 3).norm() * 256 / 0.265);
  }
}

TEST_CASE("from an arm that is stretched toward the target, where no step leads on, it is found all the same") {
  const SerialChain<3> robot(
      {.links = {{{.alpha = 0}, {.alpha = quarter}, {.a = 0.135}}}, .tip = Vector3d(0.13, 0, 0)});
  const Vector3d x(0.2, 0, 0);
  const auto found = ChainKinematics<3>(robot).inverse(x, Vector3d::Zero());
  CHECK((robot.at(found.q).position() - x).norm() < 1e-14);
  CHECK(found.status == Status::ok);
}

TEST_CASE("`near` that is not finite or beyond the limits serves as a start brought within them") {
  const ChainKinematics<3> kinematics(omni_chain());
  const Vector3d q(0.1, 0.8, -1.25), x = omni_chain().at(q).position();
  const auto lost = kinematics.inverse(x, {infinity, 0, 0});
  CHECK(lost.status == Status::not_finite);
  CHECK((lost.q - q).norm() < 1e-12);
  const auto beyond = kinematics.inverse(x, {10, 10, 10});
  CHECK(beyond.status == Status::ok);
  CHECK((beyond.q - q).norm() < 1e-12);
}

TEST_CASE("velocities whose rates are out of range give the joints at rest") {
  const ChainKinematics<3> kinematics(omni_chain());
  const Vector3d q(0.1, 0.8, -1.25), x = omni_chain().at(q).position();
  const auto motion = kinematics.inverse(x, Vector3d::Constant(1e300), Vector3d::Zero(), q);
  CHECK(has(motion.status, Status::not_finite));
  CHECK(motion.q == q);
  CHECK(motion.qdot == Vector3d::Zero());
}

TEST_CASE("settings that cannot serve are refused with their value") {
  CHECK_THROWS_WITH_AS(ChainKinematics<3>(omni_chain(), {.most_steps = 0}),
                       "ChainKinematics: most_steps: expected > 0, got 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(ChainKinematics<3>(omni_chain(), {.restarts = -1}),
                       "ChainKinematics: restarts: expected >= 0, got -1", std::invalid_argument);
  CHECK_THROWS_AS(ChainKinematics<3>(SerialChain<3>({.links = {}})), std::invalid_argument);
  CHECK_THROWS_AS(ChainKinematics<3>(SerialChain<3>({.links = {}, .tip = {1e-160, 0, 0}})), std::invalid_argument);
  CHECK_THROWS_WITH_AS(ChainKinematics<3>(SerialChain<3>({.links = {{{}, {.a = 1e160}, {}}}})),
                       "ChainKinematics: reach of the robot: expected finite and > 0, got inf", std::invalid_argument);
}
