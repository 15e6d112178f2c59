// SPDX-License-Identifier: MIT
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>

#include "omni_states.hpp"
#include "worst.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

using Eigen::Vector3d;
using limpid::has, limpid::Omni, limpid::OmniKinematics, limpid::Status;
using limpid::test::OmniState, limpid::test::OmniStates, limpid::test::Worst;

namespace {

constexpr double reach = 0.135 + 0.130, fold = 0.135 - 0.130;
const Vector3d none = Vector3d::Zero();

/// The largest rates: speed over det J / |J| of joints 2 and 3 at the edge of the damped shell, |sin q3| = 1/256.
double most_rate(double speed) { return speed * 256 * std::hypot(reach, 0.130) / (0.135 * 0.130); }

/// The Omni without its stops: every Omni's singular poses lie beyond them.
OmniKinematics<> unstopped(const Omni<>& robot = Omni<>()) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  return OmniKinematics<>(robot, {Vector3d::Constant(-inf), Vector3d::Constant(inf), inf});
}

bool all_finite(const limpid::InverseMotion<3>& motion) {
  return motion.q.allFinite() && motion.qdot.allFinite() && motion.qddot.allFinite();
}

}  // namespace

TEST_CASE("joints inside the limits come back from their tip to 1e-14, the tip from its joints to 1e-15") {
  OmniStates random(3136);
  const Omni<> robot;
  const OmniKinematics<> kinematics(robot);
  Worst joints, tip;
  Status status = Status::ok;
  for (int i = 0; i < 100'000; ++i) {
    const Vector3d q = random().q, x = robot.at(q).position();
    const auto inverse = kinematics.inverse(x);
    joints.see(inverse.q - q, i);
    tip.see(robot.at(inverse.q).position() - x, i);
    status |= inverse.status;
  }
  CAPTURE(joints);
  CAPTURE(tip);
  CHECK(joints.error() < 1e-14);
  CHECK(tip.error() < 1e-15);
  CHECK(status == Status::ok);
}

TEST_CASE("rates and accelerations come back from the tip's") {
  OmniStates random(312);
  const Omni<> robot;
  const OmniKinematics<> kinematics(robot);
  Worst rates, accelerations;
  for (int i = 0; i < 100'000; ++i) {
    const OmniState state = random();
    const auto pose = robot.at(state.q);
    const Vector3d v = pose.jacobian() * state.qdot;
    const Vector3d a = pose.jacobian_dot(state.qdot) * state.qdot + pose.jacobian() * state.qddot;  // (3.10)
    const auto motion = kinematics.inverse(pose.position(), v, a);
    rates.see(motion.qdot - state.qdot, i);
    accelerations.see(motion.qddot - state.qddot, i);
  }
  CAPTURE(rates);
  CAPTURE(accelerations);
  CHECK(rates.error() < 1e-12);          // rates up to 5, J's condition up to 100, q to 1e-14
  CHECK(accelerations.error() < 5e-12);  // terms up to 200 rad/s^2 on top
}

TEST_CASE(
    "close to the stretched and the folded arm the tip is still met to a rounding, where (3.5) loses half the digits") {
  const OmniKinematics<> kinematics = unstopped();
  for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12, 0.0}) {
    for (const double distance : {reach - gap, fold + gap}) {
      CAPTURE(distance);
      const Vector3d x = distance * Vector3d(2, 1, 2) / 3;
      const auto inverse = kinematics.inverse(x);
      CHECK((Omni<>().at(inverse.q).position() - x).norm() < 1e-15);
      CHECK_FALSE(has(inverse.status, Status::unreachable));
      if (gap == 1e-3) CHECK(inverse.status == Status::ok);
      if (gap <= 1e-9) CHECK(inverse.status == Status::singular);
    }
  }
}

TEST_CASE("a target out of reach gives the nearest point of the sphere, however far") {
  const OmniKinematics<> kinematics = unstopped();
  const Vector3d direction = Vector3d(3, -2, 6) / 7;
  for (const double distance : {0.266, 1.0, 1e10, 1e300}) {
    const auto motion = kinematics.inverse(distance * direction, {0.1, 0.2, 0.3}, {1, 2, 3});
    CHECK((Omni<>().at(motion.q).position() - reach * direction).norm() < 1e-15);
    CHECK(motion.status == (Status::unreachable | Status::singular));
    CHECK(all_finite(motion));
  }
  const auto inner = kinematics.inverse(0.001 * direction);
  CHECK((Omni<>().at(inner.q).position() - fold * direction).norm() < 1e-15);
  CHECK(has(inner.status, Status::unreachable));
}

TEST_CASE("links of very different length have a wide hole around the shoulder") {
  const Omni<> robot({.link2 = 1, .link3 = 0.1});
  const OmniKinematics<> kinematics = unstopped(robot);
  for (const double distance : {0.5, 1.3}) {  // no coordinate of the far one exceeds the hole's radius of 0.9
    const Vector3d direction = Vector3d::Ones().normalized();
    const Vector3d nearest = (distance < 1 ? 0.9 : 1.1) * direction;
    const auto inverse = kinematics.inverse(distance * direction);
    CHECK((robot.at(inverse.q).position() - nearest).norm() < 1e-14);  // roundings of 1.1 m
    CHECK(has(inverse.status, Status::unreachable));
  }
}

TEST_CASE("on the vertical axis joint 1 stays where it was, at rest") {
  const OmniKinematics<> kinematics = unstopped();
  const Vector3d near(0.4, 1, -1);
  const auto motion = kinematics.inverse({0, 0, 0.2}, {0.1, 0.2, 0.3}, none, near);
  CHECK(std::abs(motion.q[0] - 0.4) < 1e-16);
  CHECK((Omni<>().at(motion.q).position() - Vector3d(0, 0, 0.2)).norm() < 1e-15);
  CHECK(motion.qdot[0] == 0);
  CHECK(motion.status == Status::singular);
  CHECK(all_finite(motion));
  for (const Vector3d& x : {Vector3d(0, 0, 0.2), Vector3d(1e-160, 1e-170, 0.2), Vector3d(0, 0, 0)}) {
    const auto lost = kinematics.inverse(x, Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
    CHECK(lost.q.allFinite());
    CHECK(lost.q[0] == 0);
    CHECK(has(lost.status, Status::singular));
    CHECK(has(lost.status, Status::not_finite));
  }
}

TEST_CASE("at the shoulder itself links of equal and of different length give a finite answer") {
  for (const double link3 : {0.130, 0.135}) {
    const auto motion = unstopped(Omni<>({.link3 = link3})).inverse(none, {1, 2, 3}, {4, 5, 6});
    CHECK(all_finite(motion));
    CHECK(motion.status == (Status::unreachable | Status::singular));
  }
}

TEST_CASE("rates stay bounded through every singularity and are exact outside the damped shell") {
  const Omni<> robot;
  const OmniKinematics<> kinematics = unstopped(robot);
  const Vector3d v(0.3, -0.2, 0.1);
  for (int k = 0; k < 4000; ++k) {
    const double s = std::pow(10.0, -k / 200.0);  // from 1 rad down to 1e-20 rad, or of 0.2 m, off the singular pose
    const Vector3d stretched = robot.at({0.2, 0.7, -s}).position(),
                   folded = robot.at({0.2, 0.7, s - 3.14159}).position();
    const Vector3d upright = 0.2 * Vector3d(s * std::cos(0.2), s * std::sin(0.2), std::sqrt(1 - s * s));
    for (const Vector3d& x : {stretched, folded, upright}) {
      const auto motion = kinematics.inverse(x, v, none);
      REQUIRE(all_finite(motion));
      REQUIRE(motion.qdot.norm() < most_rate(v.norm()));
      if (motion.status == Status::ok) {
        REQUIRE((robot.at(motion.q).jacobian() * motion.qdot - v).norm() < 1e-11);  // 256 roundings of a speed and of q
      } else {
        REQUIRE(motion.status == Status::singular);
      }
    }
  }
}

TEST_CASE("rates are continuous where damping sets in") {
  const Omni<> robot;
  const OmniKinematics<> kinematics = unstopped(robot);
  const double edge = std::asin(1.0 / 256), v = 0.3;
  const auto rates = [&](double q3) {
    return kinematics.inverse(robot.at({0.2, 0.7, q3}).position(), Vector3d::Constant(v), none).qdot;
  };
  const Vector3d outside = rates(-edge * (1 + 1e-9)), inside = rates(-edge * (1 - 1e-9));
  CHECK((outside - inside).norm() < 1e-5 * outside.norm());
}

TEST_CASE("the lost direction is given up, the others kept: a stretched arm still turns") {
  const Omni<> robot;
  const Vector3d q(0, 0.5, 0);
  const Vector3d outward(std::cos(0.5), 0, std::sin(0.5)), upward(-std::sin(0.5), 0, std::cos(0.5)), sideways(0, 1, 0);
  const OmniKinematics<> kinematics = unstopped(robot);
  const auto pose = robot.at(q);
  CHECK(kinematics.inverse(pose.position(), outward, none).qdot.norm() < 1e-9);
  for (const Vector3d& v : {upward, sideways}) {
    const Vector3d qdot = kinematics.inverse(pose.position(), v, none).qdot;
    CHECK((pose.jacobian() * qdot - v).norm() < 1e-5);  // the damping's share, (2.6e-4 m / reach)^2
  }
}

TEST_CASE("speeds beyond the range of the scalar give the position at rest and say so") {
  const OmniKinematics<float> kinematics{Omni<float>()};
  const Eigen::Vector3f x(0.18F, 0, 0.05F), fast(1e30F, 0, 0), still(0, 0, 0);
  const auto motion = kinematics.inverse(x, fast, still);
  CHECK(motion.q == kinematics.inverse(x).q);
  CHECK(motion.qdot == still);
  CHECK(motion.qddot == still);
  CHECK(motion.status == Status::not_finite);
}

TEST_CASE("a target that the joints' limits keep from the tip is unreachable, with the joints that were held at rest") {
  const OmniKinematics<> kinematics{Omni<>()};
  const auto limits = Omni<>().limits();
  struct Case {
    Vector3d x, q;  // by hand where a joint is at its limit; NaN elsewhere
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Case cases[] = {
      {{-0.2, 0, 0}, {limits.upper[0], nan, nan}},  // behind the arm
      {{0.2641, 0, 0}, {nan, nan, -0.25}},          // stretched too far
      {{0.1, 0, -0.2}, {nan, 0, nan}},              // below
      {{0, -0.2, 0.05}, {limits.lower[0], nan, nan}},
      {{0.005, 0, 0.02}, {nan, nan, -2.45}},  // folded too far
  };
  for (const Case& c : cases) {
    CAPTURE(c.x);
    const Vector3d free = unstopped().inverse(c.x).q;
    const auto motion = kinematics.inverse(c.x, {0.1, 0.2, -0.3}, {1, -2, 3});
    CHECK(has(motion.status, Status::unreachable));
    CHECK(kinematics.inverse(c.x).q == motion.q);
    CHECK(all_finite(motion));
    for (int i = 0; i < 3; ++i) {
      CHECK(motion.q[i] <= limits.upper[i]);
      CHECK(motion.q[i] >= limits.lower[i]);
      if (!std::isnan(c.q[i])) CHECK(motion.q[i] == c.q[i]);
      CHECK((motion.q[i] == free[i]) == (motion.qdot[i] != 0));  // all of these velocities turn every free joint
      if (motion.q[i] != free[i]) CHECK(motion.qddot[i] == 0);
    }
  }
}

TEST_CASE("joints beyond the limits go to the nearest ones within them") {
  OmniStates random(54);
  const Omni<> robot;
  const auto limits = robot.limits();
  const OmniKinematics<> kinematics(robot);
  const auto inside = [&](const Vector3d& q) {
    return (q.array() <= limits.upper.array()).all() && (q.array() >= limits.lower.array()).all() &&
           q[1] + q[2] <= Omni<>::elbow_sum_limit() + 1e-15;
  };
  int held = 0, by_cables = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Vector3d q(random.uniform(-3, 3), random.uniform(-1.5, 3), random.uniform(-3, 0));
    if (robot.link2() * std::cos(q[1]) + robot.link3() * std::cos(q[1] + q[2]) < 0.01) continue;  // before the axis
    const Vector3d free = unstopped(robot).inverse(robot.at(q).position()).q;
    const auto inverse = kinematics.inverse(robot.at(q).position());
    const Vector3d other = random().q;  // of the admissible ones
    REQUIRE(inside(inverse.q));
    REQUIRE(has(inverse.status, Status::unreachable) == !inside(free));
    REQUIRE((inverse.q - free).dot(inverse.q - other) <= 1e-14);  // what makes it the nearest of a convex set
    held += !inside(free);
    by_cables += std::abs(inverse.q[1] + inverse.q[2] - Omni<>::elbow_sum_limit()) < 1e-15;
  }
  CHECK(held > 10'000);
  CHECK(by_cables > 1'000);
}

TEST_CASE("where joint 3 alone leaves the range of float, by the difference of its links, the answer stays finite") {
  const OmniKinematics<float> kinematics{Omni<float>()};
  const Eigen::Vector3f zero = Eigen::Vector3f::Zero(), near(0, 0.8F, -1.3F);
  const auto pulled =
      kinematics.inverse({0.125784248F, -0.0934547633F, 0.128365308F}, zero, {-5.01506561e37F, 0, 0}, near);
  CHECK(is_finite(pulled));
  CHECK(has(pulled.status, Status::not_finite));
  const auto thrown =
      kinematics.inverse({0.189753473F, 0.0665010661F, -0.0850099102F}, {0, 2.54617316e18F, 0}, zero, near);
  CHECK(is_finite(thrown));
  CHECK(has(thrown.status, Status::not_finite));
}

TEST_CASE_TEMPLATE("joints on their limits are not beyond them for a rounding", Scalar, float, double, long double) {
  using Joints = Eigen::Matrix<Scalar, 3, 1>;
  const Omni<Scalar> robot;
  const OmniKinematics<Scalar> kinematics(robot);
  const auto limits = robot.limits();
  const Joints still = Joints::Zero();
  OmniStates random(51);
  int trials = 0;
  for (int i = 0; i < 30'000; ++i) {
    Joints q = random().q.template cast<Scalar>();
    const int side = i % 7;
    if (side == 6) {
      q[2] = robot.elbow_sum_limit() - q[1];
      if (q[2] > limits.upper[2] || q[2] < limits.lower[2]) continue;
    } else {
      q[side % 3] = side < 3 ? limits.lower[side] : limits.upper[side - 3];
      if (q[1] + q[2] > robot.elbow_sum_limit()) continue;
    }
    const auto pose = robot.at(q);
    const auto motion = kinematics.inverse(pose.position(), pose.jacobian() * Joints::Ones(), still);
    REQUIRE(motion.status == Status::ok);
    REQUIRE((motion.qdot - Joints::Ones()).norm() < 2000 * std::numeric_limits<Scalar>::epsilon());  // J's condition
    ++trials;
  }
  CHECK(trials > 15'000);
}

TEST_CASE("limits within which no joints are, are refused") {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const Omni<> robot;
  CHECK_THROWS_WITH_AS(OmniKinematics<>(robot, {Vector3d(0, 2, 0), Vector3d(1, 1, 1), inf}),
                       "OmniKinematics: lower: expected <= upper, got 0 2 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(OmniKinematics<>(robot, {Vector3d(0, 1, 1), Vector3d(1, 1, 1), 1.5}),
                       "OmniKinematics: elbow_sum: expected >= the sum of the lower limits, got 1.5",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(OmniKinematics<>(robot, {Vector3d(0, inf, 0), Vector3d(1, inf, 1), inf}),
                       "OmniKinematics: lower: expected below infinity, got 0 inf 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(OmniKinematics<>(robot, {Vector3d(0, -inf, 0), Vector3d(1, -inf, 1), inf}),
                       "OmniKinematics: upper: expected above -infinity, got 1 -inf 1", std::invalid_argument);
  CHECK_THROWS_WITH_AS(OmniKinematics<>(robot, {Vector3d(-1, -inf, 0), Vector3d(1, 1, 1), -inf}),
                       "OmniKinematics: elbow_sum: expected above -infinity, got -inf", std::invalid_argument);
}

TEST_CASE(
    "an arm whose lengths leave the range in their fourth power is refused, any other has the joints of its shape") {
  for (const double link : {1e-160, 1e-80, 1e100, 1e160}) {
    CAPTURE(link);
    CHECK_THROWS_AS((void)OmniKinematics<>(Omni<>({.link2 = link, .link3 = 0.9 * link})), std::invalid_argument);
  }
  CHECK_THROWS_WITH_AS((void)OmniKinematics<>(Omni<>({.link2 = 1e100, .link3 = 1e100})),
                       "OmniKinematics: links: expected lengths whose fourth power is finite, got 2e+100",
                       std::invalid_argument);
  const Vector3d x(0.16, 0.03, 0.02), v(0.1, -0.2, 0.3), a(1, 2, -3);
  const auto usual = OmniKinematics<>(Omni<>()).inverse(x, v, a);
  for (const double scale : {std::ldexp(1.0, 200), std::ldexp(1.0, -200)}) {  // lengths without rounding
    const OmniKinematics<> scaled(Omni<>({.link2 = 0.135 * scale, .link3 = 0.130 * scale}));
    const auto motion = scaled.inverse(x * scale, v * scale, a * scale);
    CHECK(motion.status == Status::ok);
    CHECK(motion.q.isApprox(usual.q, 1e-14));  // roundings in another order at most
    CHECK(motion.qdot.isApprox(usual.qdot, 1e-14));
    CHECK(motion.qddot.isApprox(usual.qddot, 1e-13));
  }
}
