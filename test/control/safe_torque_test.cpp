// SPDX-License-Identifier: MIT
#include <limpid/control/safe_torque.hpp>

#include <doctest/doctest.h>

#include <type_traits>
#include <utility>

using limpid::SafeTorque;

namespace {

using Torque = SafeTorque<3>;
using Vector = Eigen::Vector3d;

template <typename T>
concept CanBeChanged = requires(T torque) {
  torque.value() = Vector(1, 1, 1);
};

template <typename T>
concept CanBeBraced = requires {
  T{Vector(1, 1, 1)};
};

static_assert(std::is_default_constructible_v<Torque>);
static_assert(std::is_copy_assignable_v<Torque>);
static_assert(!std::is_constructible_v<Torque, Vector>, "only a SafetyLimiter makes one that is not zero");
static_assert(!std::is_convertible_v<Vector, Torque>);
static_assert(!std::is_assignable_v<Torque&, Vector>);
static_assert(!std::is_aggregate_v<Torque>);
static_assert(!CanBeBraced<Torque>);
static_assert(!CanBeChanged<Torque>);

}  // namespace

TEST_CASE("a torque that no limiter has made is zero") { CHECK(Torque{}.value() == Vector::Zero()); }
