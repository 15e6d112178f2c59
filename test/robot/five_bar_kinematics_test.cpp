// SPDX-License-Identifier: MIT
#include <limpid/robot/five_bar.hpp>
#include <limpid/robot/five_bar_kinematics.hpp>

#include "worst.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using Eigen::Vector2d, Eigen::Vector3d;
using limpid::FiveBar, limpid::FiveBarKinematics, limpid::has, limpid::Status, limpid::test::Worst;

static_assert(limpid::InverseKinematics<FiveBarKinematics<>> && limpid::InverseKinematics<FiveBarKinematics<float>>);
static_assert(!limpid::InverseKinematics<FiveBar<>> && !limpid::Robot<FiveBarKinematics<>>);

namespace {

/// Joints within the limits, rates up to 5 rad/s, accelerations up to 50 rad/s^2.
class States {
 public:
  explicit States(unsigned seed) : random_{seed} {}
  Vector2d any(double size) { return size * Vector2d(uniform_(random_), uniform_(random_)); }
  Vector2d inside(const FiveBar<>& robot) {
    const auto limits = robot.limits();
    return (limits.lower + limits.upper) / 2 + any(0.5).cwiseProduct(limits.upper - limits.lower);
  }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

bool within_limits(const FiveBar<>& robot, const Vector2d& q) {
  const auto limits = robot.limits();
  return (q.array() >= limits.lower.array()).all() && (q.array() <= limits.upper.array()).all();
}

}  // namespace

TEST_CASE("joints inside the limits come back from their tip, the tip from its joints, rates and accelerations") {
  States random(71);
  for (const FiveBar<>& robot : {FiveBar<>(), FiveBar<>({.base = 0.06, .proximal = 0.18, .distal = 0.23})}) {
    const FiveBarKinematics<> kinematics(robot);
    Worst joints, tip, rates, accelerations;
    Status status = Status::ok;
    for (int i = 0; i < 10'000; ++i) {
      const Vector2d q = random.inside(robot), qdot = random.any(5), qddot = random.any(50);
      const auto pose = robot.at(q);
      const Vector3d x = pose.position(), v = pose.jacobian() * qdot;
      const Vector3d a = pose.jacobian_dot(qdot) * qdot + pose.jacobian() * qddot;  // (3.10)
      const auto motion = kinematics.inverse(x, v, a);
      joints.see(motion.q - q, i);
      tip.see(robot.at(motion.q).position() - x, i);
      rates.see(motion.qdot - qdot, i);
      accelerations.see(motion.qddot - qddot, i);
      status |= motion.status;
    }
    CAPTURE(joints);
    CAPTURE(tip);
    CAPTURE(rates);
    CAPTURE(accelerations);
    CHECK(joints.error() < 1e-14);  // a rounding of 0.3 m over w > 0.025 m
    CHECK(tip.error() < 5e-15);
    CHECK(rates.error() < 1e-12);          // rates up to 5, J's condition up to 100
    CHECK(accelerations.error() < 2e-11);  // terms up to 1000 rad/s^2 on top
    CHECK(status == Status::ok);
  }
}

TEST_CASE("a tip on the axis of symmetry has its elbows outward by the law of cosines") {
  const FiveBar<> robot({.lower = {1.65, 0.8}, .upper = {2.3, 1.5}});
  const double y = 0.3, r = std::hypot(0.05, y), angle = std::atan2(y, -0.05) - std::acos(r / 0.4);
  const auto joints = FiveBarKinematics<>(robot).inverse({0, y, 0});
  CHECK((joints.q - Vector2d(std::acos(-1.0) - angle, angle)).cwiseAbs().maxCoeff() < 2e-15);
  CHECK(joints.status == Status::ok);
}

TEST_CASE("beyond its limits a joint stays there, and the other moves as if it had not") {
  const FiveBar<> robot;
  const FiveBarKinematics<> kinematics(robot);
  const auto pose = robot.at({2.1, 0.6});  // q1 beyond its 1.98
  const Vector2d qdot(0.5, -0.25);
  const Vector3d v = pose.jacobian() * qdot, a = pose.jacobian_dot(qdot) * qdot;
  const auto motion = kinematics.inverse(pose.position(), v, a);
  CHECK(motion.q[0] == 1.98);
  CHECK(std::abs(motion.q[1] - 0.6) < 1e-14);
  CHECK(motion.qdot[0] == 0);
  CHECK(std::abs(motion.qdot[1] + 0.25) < 1e-13);
  CHECK(motion.qddot[0] == 0);
  CHECK(std::abs(motion.qddot[1]) < 1e-12);
  CHECK(motion.status == Status::unreachable);
}

TEST_CASE("wherever the target is, the joints are within the limits and all is finite and bounded") {
  States random(72);
  const FiveBar<> robot;
  const FiveBarKinematics<> kinematics(robot);
  int reached = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vector2d place = random.any(i % 4 == 0 ? 100 : 0.5), v = random.any(1), a = random.any(10);
    const auto motion = kinematics.inverse({place[0], place[1], 0}, {v[0], v[1], 0}, {a[0], a[1], 0});
    const Vector2d tip = robot.at(motion.q).position().head<2>();
    if (!within_limits(robot, motion.q)) FAIL("beyond the limits: ", motion.q.transpose());
    // |v| over w's least in magnitude, l1/256, and |a|, e'' and |v - e'|^2 / l2 over it
    if (!(motion.qdot.norm() < 3000 && motion.qddot.allFinite())) FAIL("not bounded at ", place.transpose());
    const bool there = (tip - place).norm() < 1e-14;
    if (there != (motion.status == Status::ok)) FAIL("status at ", place.transpose());
    reached += there ? 1 : 0;
  }
  CHECK(reached > 100);
}

TEST_CASE("far targets draw the tip toward them, those behind the elbows to the most open pose") {
  const FiveBar<> robot;
  const FiveBarKinematics<> kinematics(robot);
  const auto limits = robot.limits();
  for (const double far : {1.0, 1e10, 1e300}) {
    CHECK(kinematics.inverse({far, 0.01 * far, 0}).q == limits.lower);
    CHECK(kinematics.inverse({-far, 0.01 * far, 0}).q == limits.upper);
    const auto below = kinematics.inverse({0, -far, 0}, {1, 1, 0}, {1, 1, 0});
    CHECK(below.q == Vector2d(limits.upper[0], limits.lower[1]));
    CHECK(below.qdot == Vector2d::Zero());
    CHECK(has(below.status, Status::unreachable));
    CHECK(kinematics.inverse({0, far, 0}).q[1] == limits.upper[1]);
  }
  // the tip that another assembly has at joints within the limits
  const Vector2d q(1.9, 0.5), elbow1(-0.05 + 0.2 * std::cos(1.9), 0.2 * std::sin(1.9));
  const Vector2d elbow2(0.05 + 0.2 * std::cos(0.5), 0.2 * std::sin(0.5));
  const Vector2d mirrored = elbow1 + elbow2 - robot.at(q).position().head<2>();
  const auto behind = kinematics.inverse({mirrored[0], mirrored[1], 0});
  CHECK(behind.status == Status::unreachable);
  CHECK(behind.q == Vector2d(limits.upper[0], limits.lower[1]));
}

TEST_CASE("a target on a base joint, where links of equal length fold, has an answer") {
  const FiveBar<> robot;
  for (const double side : {-0.05, 0.05}) {
    const auto motion = FiveBarKinematics<>(robot).inverse({side, 0, 0}, {0.1, 0.2, 0}, {1, 2, 0});
    CHECK(within_limits(robot, motion.q));
    CHECK((motion.qdot.allFinite() && motion.qddot.allFinite()));
    CHECK(has(motion.status, Status::unreachable));
  }
}

TEST_CASE("off the plane the target's foot is met, and the status says that the target is not") {
  const FiveBar<> robot;
  const FiveBarKinematics<> kinematics(robot);
  const Vector3d x = robot.at({1.75, 0.75}).position(), up(0, 0, 0.01), none = Vector3d::Zero();
  CHECK(kinematics.inverse(x + up).status == Status::unreachable);
  CHECK(kinematics.inverse(x + up).q == kinematics.inverse(x).q);
  CHECK(kinematics.inverse(x, {1, 0, 1e-3}, none).status == Status::unreachable);
  CHECK(kinematics.inverse(x, none, {1, 0, -1e-3}).status == Status::unreachable);
  CHECK(kinematics.inverse(x, {1, 0, 1e-3}, none).qdot == kinematics.inverse(x, {1, 0, 0}, none).qdot);
  CHECK(kinematics.inverse(x + 1e-14 * up, {1, 0, 1e-16}, none).status == Status::ok);  // rounding of other frames
}

TEST_CASE("links so long or so short that the equations leave the range of the scalar are refused") {
  for (const double length : {1e-80, 1e80}) {
    const FiveBar<> robot({.base = length / 10, .proximal = length / 5, .distal = length / 5});
    CHECK_THROWS_AS((void)FiveBarKinematics<>{robot}, std::invalid_argument);
  }
  const FiveBar<> galactic({.base = 1e20, .proximal = 2e20, .distal = 2e20});
  const Eigen::Vector2d q(1.7, 0.8);
  CHECK((FiveBarKinematics<>(galactic).inverse(galactic.at(q).position()).q - q).norm() < 1e-14);
}

TEST_CASE("rates beyond any range leave the joints at rest at the target") {
  const FiveBar<> robot;
  const FiveBarKinematics<> kinematics(robot);
  const Vector3d x = robot.at({1.75, 0.75}).position();
  const auto motion = kinematics.inverse(x, {1e300, 0, 0}, {0, 0, 0});
  CHECK(motion.q == kinematics.inverse(x).q);
  CHECK(motion.qdot == Vector2d::Zero());
  CHECK(motion.status == Status::not_finite);
}
