// SPDX-License-Identifier: MIT
#include <limpid/control/torque_set.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

using limpid::Status;
using limpid::TorqueSet;

using Vector = Eigen::Vector3d;

TEST_CASE("a torque in the set is left as it is") {
  TorqueSet<3, double, 1> set(Vector(1, 2, 3));
  set.narrow_positive(0, 0.0, Status::joint_limit);
  set.demand(Vector(0, 1, -1), 0.0, Status::workspace_limit);
  const auto [torque, status] = set.fit(Vector(-1, 2, -3));
  CHECK(torque == Vector(-1, 2, -3));
  CHECK(status == Status::ok);
}

TEST_CASE("each entry is clamped to its interval, and the status names the rule behind the bound") {
  TorqueSet<3, double> set(Vector(1, 2, 3));
  set.narrow_positive(1, 0.0, Status::joint_limit);
  CHECK(set.fit(Vector(1.5, 0, 0)).status == Status::limited);
  CHECK(set.fit(Vector(0, 0, -4)).status == Status::limited);
  CHECK(set.fit(Vector(0, 0.5, 0)).status == Status::joint_limit);
  CHECK(set.fit(Vector(0, -2.5, 0)).status == Status::limited);
  CHECK(set.fit(Vector(9, 9, -9)).status == (Status::limited | Status::joint_limit));
  CHECK(set.fit(Vector(9, 9, -9)).torque == Vector(1, 0, -3));
}

TEST_CASE("two rules behind one bound are both named") {
  TorqueSet<3, double> set(Vector(1, 2, 3));
  set.narrow_negative(2, 0.0, Status::joint_limit);
  set.narrow_negative(2, 0.0, Status::workspace_limit);
  CHECK(set.fit(Vector(0, 0, -1)).status == (Status::joint_limit | Status::workspace_limit));
}

TEST_CASE("a share of a joint's torques passes, and of several rules the strictest holds and is named") {
  TorqueSet<3, double> set(Vector(1, 2, 4));
  set.narrow_positive(1, 0.5, Status::joint_limit);
  set.narrow_positive(2, 0.5, Status::joint_limit);
  set.narrow_positive(2, 0.25, Status::workspace_limit);
  set.narrow_positive(2, 0.75, Status::joint_limit);
  set.narrow_negative(2, 0.25, Status::joint_limit);
  set.narrow_negative(0, 1.0, Status::joint_limit);
  CHECK(set.fit(Vector(0, 9, 0)).torque == Vector(0, 1, 0));
  CHECK(set.fit(Vector(0, 9, 0)).status == Status::joint_limit);
  CHECK(set.fit(Vector(0, 0, 9)).torque == Vector(0, 0, 1));
  CHECK(set.fit(Vector(0, 0, 9)).status == Status::workspace_limit);
  CHECK(set.fit(Vector(-9, 0, -9)).torque == Vector(-1, 0, -1));
  CHECK(set.fit(Vector(-9, 0, 0)).status == Status::limited);
}

TEST_CASE("what violates a half-space goes straight back onto its plane") {
  TorqueSet<3, double, 1> set(Vector(9, 9, 9));
  set.demand(Vector(1, -2, -1), 0.0, Status::workspace_limit);
  const auto [torque, status] = set.fit(Vector(3, 1, 4));  // 3 - 2 - 4 = -3, over 1 + 4 + 1: half the normal
  CHECK(status == Status::workspace_limit);
  CHECK((torque - Vector(3.5, 0, 3.5)).norm() < 1e-13);  // the dozen roundings of 36 that are kept clear of the plane
  CHECK(Vector(1, -2, -1).dot(torque) >= 0);
}

TEST_CASE("an entry that meets its bound on the way stays there, and the others go on") {
  TorqueSet<3, double, 1> set(Vector(9, 9, 9));
  set.narrow_positive(0, 0.0, Status::joint_limit);
  set.demand(Vector(1, 0, 1), 0.0, Status::workspace_limit);
  CHECK((set.fit(Vector(-2, 5, -4)).torque - Vector(0, 5, 0)).norm() < 1e-13);
}

TEST_CASE("a share of what a half-space takes passes") {
  TorqueSet<3, double, 1> set(Vector(1, 2, 3));
  set.demand(Vector(0, -1, 1), 0.5, Status::workspace_limit);  // tau3 - tau2 >= -5 / 2
  CHECK(set.fit(Vector(1, 1, -1.5)).torque == Vector(1, 1, -1.5));
  CHECK((set.fit(Vector(1, 1, -2)).torque - Vector(1, 0.75, -1.75)).norm() < 1e-13);
  TorqueSet<3, double, 1> whole(Vector(1, 2, 3));
  whole.demand(Vector(0, -1, 1), 1.0, Status::workspace_limit);
  CHECK(whole.fit(Vector(1, 2, -3)).torque == Vector(1, 2, -3));
}

TEST_CASE("one rule more than there is room for leaves zero torque, not a write beyond the set") {
  TorqueSet<3, double, 1> set(Vector(1, 2, 3));
  set.demand(Vector(0, -1, 1), 0.0, Status::workspace_limit);
  set.demand(Vector(0, 1, 1), 0.0, Status::workspace_limit);
  CHECK(set.fit(Vector(1, -2, 3)).torque == Vector::Zero());
  CHECK(set.fit(Vector(1, -2, 3)).status == Status::workspace_limit);
  TorqueSet<3, double> none(Vector(1, 2, 3));
  none.demand(Vector(0, -1, 1), 0.0, Status::workspace_limit);
  CHECK(none.fit(Vector(1, -2, 3)).torque == Vector::Zero());
}

TEST_CASE("with several half-spaces every answer is in the set, and within the intervals") {
  std::mt19937 random(65);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto draw = [&] { return Vector(uniform(random), uniform(random), uniform(random)); };
  for (int i = 0; i < 100'000; ++i) {
    TorqueSet<3, double, 3> set(Vector(0.5, 0.5, 0.5));
    const Vector normals[] = {draw(), draw(), draw()};
    for (const Vector& normal : normals) set.demand(normal, 0.0, Status::workspace_limit);
    const Vector torque = set.fit(draw()).torque;
    CAPTURE(i);
    for (const Vector& normal : normals) REQUIRE(normal.dot(torque) >= 0);
    REQUIRE(torque.cwiseAbs().maxCoeff() <= 0.5);
  }
}

TEST_CASE("with one half-space no torque of the set is nearer to the clamped one, and none is lengthened") {
  std::mt19937 random(66);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto draw = [&] { return Vector(uniform(random), uniform(random), uniform(random)); };
  for (int i = 0; i < 100'000; ++i) {
    TorqueSet<3, double, 1> set(Vector(0.5, 0.6, 0.7));
    const Vector normal = draw();
    const double share = std::max(0.0, uniform(random));
    const double slack = share * normal.cwiseAbs().dot(Vector(0.5, 0.6, 0.7));
    set.demand(normal, share, Status::workspace_limit);
    const Vector clamped = draw().cwiseMin(Vector(0.5, 0.6, 0.7)).cwiseMax(-Vector(0.5, 0.6, 0.7));
    const Vector torque = set.fit(clamped).torque, other = draw().cwiseProduct(Vector(0.5, 0.6, 0.7));
    CAPTURE(i);
    REQUIRE(torque.norm() <= clamped.norm() + 1e-12);  // the roundings kept clear of the plane, over a small normal
    if (normal.dot(other) < -slack) continue;
    REQUIRE((torque - clamped).dot(torque - other) <= 1e-12);  // what makes it the nearest of a convex set
  }
}
