// SPDX-License-Identifier: MIT
#include <limpid/robot/omni.hpp>
#include <limpid/robot/robot.hpp>

#include "conformance/robot_suite.hpp"
#include "support/pendulum.hpp"

#include <doctest/doctest.h>

using limpid::Omni;
using limpid::test::check_robot;

namespace foreign {

/// An arm with other names, by someone who has never heard of limpid.
struct Swing {
  limpid::test::Pendulum<> arm;
};

}  // namespace foreign

template <>
struct limpid::RobotTraits<foreign::Swing> {
  using Scalar = double;
  static constexpr int joints = 1;
  static constexpr int parameters = 3;

  static auto at(const foreign::Swing& swing, const Eigen::Matrix<double, 1, 1>& q) noexcept { return swing.arm.at(q); }
  static auto limits(const foreign::Swing& swing) noexcept { return swing.arm.limits(); }
};

namespace {

struct WithoutRegressor : limpid::test::Pendulum<>::Pose {
  void regressor() const = delete;  // hides both
};
struct Incomplete : limpid::test::Pendulum<> {
  WithoutRegressor at(const Vector& q) const { return {limpid::test::Pendulum<>::at(q)}; }
};
struct WithoutLimits : limpid::test::Pendulum<> {
  void limits() const {}
};

}  // namespace

static_assert(limpid::Robot<Omni<float>> && limpid::Robot<Omni<>> && limpid::Robot<Omni<long double>>);
static_assert(limpid::Robot<limpid::test::Pendulum<>>);
static_assert(limpid::Robot<foreign::Swing>, "by its trait alone");
static_assert(!limpid::Robot<int> && !limpid::Robot<Incomplete> && !limpid::Robot<WithoutLimits>);

TEST_CASE("Omni is a Robot, with any links and without gravity too") {
  check_robot(Omni<>(), Omni<>::table_5_2(), 31);
  check_robot(Omni<>({.link2 = 0.2, .link3 = 0.05, .gravity = 0}), Omni<>::table_5_2(), 32);
}

TEST_CASE("an arm of another kind is a Robot by its trait") { check_robot(foreign::Swing{}, {0.5, 4.0, 0.1}, 33); }
