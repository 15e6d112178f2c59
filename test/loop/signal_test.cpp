// SPDX-License-Identifier: MIT
#include <limpid/loop/signal.hpp>

#include <doctest/doctest.h>

namespace scene {

struct JointTorque {
  using value_type = double;
};
struct Force {
  using value_type = double;
  static constexpr const char* name = "operator force";
};
template <typename Scalar, int Axes>
struct Motion {
  using value_type = Scalar;
};
struct NoValue {};

}  // namespace scene

namespace {

struct Hidden {
  using value_type = int;
};

}  // namespace

TEST_CASE("a signal is any type with a value_type") {
  static_assert(limpid::Signal<scene::JointTorque>);
  static_assert(limpid::Signal<limpid::Previous<scene::JointTorque>>);
  static_assert(!limpid::Signal<scene::NoValue>);
  static_assert(!limpid::Signal<double>);
}

TEST_CASE("a name is the type's own, without scopes and template arguments") {
  struct Local {};
  CHECK(limpid::name_of<scene::JointTorque>() == "JointTorque");
  CHECK(limpid::name_of<scene::Motion<scene::Motion<double, 1>, 3>>() == "Motion");
  CHECK(limpid::name_of<Hidden>() == "Hidden");
  CHECK(limpid::name_of<Local>() == "Local");
}

TEST_CASE("a name that is given stands") { CHECK(limpid::name_of<scene::Force>() == "operator force"); }
