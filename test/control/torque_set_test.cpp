// SPDX-License-Identifier: MIT
#include <limpid/control/torque_set.hpp>

#include <doctest/doctest.h>

#include <random>

using limpid::Status;
using limpid::TorqueSet;

using Vector = Eigen::Vector3d;

TEST_CASE("a torque in the set is left as it is") {
  TorqueSet<3, double, 1> set(Vector(1, 2, 3));
  set.forbid_positive(0, Status::joint_limit);
  set.demand(Vector(0, 1, -1), Status::workspace_limit);
  const auto [torque, status] = set.fit(Vector(-1, 2, -3));
  CHECK(torque == Vector(-1, 2, -3));
  CHECK(status == Status::ok);
}

TEST_CASE("each entry is clamped to its interval, and the status names the rule behind the bound") {
  TorqueSet<3, double> set(Vector(1, 2, 3));
  set.forbid_positive(1, Status::joint_limit);
  CHECK(set.fit(Vector(1.5, 0, 0)).status == Status::limited);
  CHECK(set.fit(Vector(0, 0, -4)).status == Status::limited);
  CHECK(set.fit(Vector(0, 0.5, 0)).status == Status::joint_limit);
  CHECK(set.fit(Vector(0, -2.5, 0)).status == Status::limited);
  CHECK(set.fit(Vector(9, 9, -9)).status == (Status::limited | Status::joint_limit));
  CHECK(set.fit(Vector(9, 9, -9)).torque == Vector(1, 0, -3));
}

TEST_CASE("two rules behind one bound are both named") {
  TorqueSet<3, double> set(Vector(1, 2, 3));
  set.forbid_negative(2, Status::joint_limit);
  set.forbid_negative(2, Status::workspace_limit);
  CHECK(set.fit(Vector(0, 0, -1)).status == (Status::joint_limit | Status::workspace_limit));
}

TEST_CASE("what opposes a half-space is scaled down until the rest balances it") {
  TorqueSet<3, double, 1> set(Vector(9, 9, 9));
  set.demand(Vector(1, -2, -1), Status::workspace_limit);
  const auto [torque, status] = set.fit(Vector(3, 1, 4));  // 3 - 2 - 4 = -3: the last two times 1/2
  CHECK(status == Status::workspace_limit);
  CHECK(torque[0] == 3.0);
  CHECK(torque[1] == doctest::Approx(0.5).epsilon(1e-14));  // less the dozen roundings kept clear of balance
  CHECK(torque[2] == doctest::Approx(2.0).epsilon(1e-14));
  CHECK(Vector(1, -2, -1).dot(torque) >= 0);
}

TEST_CASE("with nothing to balance it, what opposes a half-space goes altogether") {
  TorqueSet<3, double, 1> set(Vector(9, 9, 9));
  set.demand(Vector(0, -2, -1), Status::workspace_limit);
  CHECK(set.fit(Vector(5, 1, 4)).torque == Vector(5, 0, 0));
}

TEST_CASE("with several half-spaces every answer is in the set, and never beyond what was wanted") {
  std::mt19937 random(65);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto draw = [&] { return Vector(uniform(random), uniform(random), uniform(random)); };
  for (int i = 0; i < 100'000; ++i) {
    TorqueSet<3, double, 3> set(Vector(0.5, 0.5, 0.5));
    const Vector normals[] = {draw(), draw(), draw()};
    for (const Vector& normal : normals) set.demand(normal, Status::workspace_limit);
    const Vector wanted = draw(), torque = set.fit(wanted).torque;
    CAPTURE(i);
    for (const Vector& normal : normals) REQUIRE(normal.dot(torque) >= 0);
    for (int j = 0; j < 3; ++j) {
      REQUIRE(torque[j] * wanted[j] >= 0);
      REQUIRE(std::abs(torque[j]) <= std::min(0.5, std::abs(wanted[j])));
    }
  }
}
