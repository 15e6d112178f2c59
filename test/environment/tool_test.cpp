// SPDX-License-Identifier: MIT
#include <limpid/environment/tool.hpp>

#include <doctest/doctest.h>

#include <limits>

using limpid::Motion;
using limpid::Tool;
using limpid::ToolState;

TEST_CASE("a tool of nothing but a mass is one, and a default one is not") {
  CHECK_NOTHROW(Tool<3>({.mass = 0.1}).check());
  CHECK_THROWS_WITH_AS(Tool<3>{}.check(), "Tool: mass: expected finite and > 0, got 0", std::invalid_argument);
}

TEST_CASE("what no tool can have is refused with its value") {
  CHECK_THROWS_WITH_AS(Tool<1>({.mass = -0.1}).check(), "Tool: mass: expected finite and > 0, got -0.1",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Tool<1>({.mass = 1, .damping = -2}).check(), "Tool: damping: expected finite and >= 0, got -2",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Tool<1>({.mass = 1, .stiffness = std::numeric_limits<double>::infinity()}).check(),
                       "Tool: stiffness: expected finite and >= 0, got inf", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Tool<2>({.mass = 1, .anchor = {0.5, std::numeric_limits<double>::quiet_NaN()}}).check(),
                       "Tool: anchor: expected finite, got 0.5 nan", std::invalid_argument);
}

TEST_CASE("what is too large for so small a mass is refused by its own name") {
  CHECK_THROWS_WITH_AS(Tool<1>({.mass = 1e-310}).check(), "Tool: mass: expected a finite 1/mass, got 1e-310",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Tool<1>({.mass = 0.1, .damping = 1.7e308}).check(),
                       "Tool: damping: expected finite over the mass, got 1.7e+308", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Tool<1>({.mass = 0.1, .stiffness = 1.7e308}).check(),
                       "Tool: stiffness: expected finite over the mass, got 1.7e+308", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Tool<2>({.mass = 1, .stiffness = 1e10, .anchor = {0, 1e300}}).check(),
                       "Tool: anchor: expected a finite force of the spring over the mass, got 0 1e+300",
                       std::invalid_argument);
}

TEST_CASE("motions add and scale part by part") {
  const Motion<2> a{.x = {1, 2}, .v = {3, 4}, .a = {5, 6}}, b{.x = {1, 1}, .v = {1, 1}, .a = {1, 1}};
  const Motion<2> c = (a - b) * 2.0 + 0.5 * b;
  CHECK((c.x == Eigen::Array2d{0.5, 2.5}).all());
  CHECK((c.v == Eigen::Array2d{4.5, 6.5}).all());
  CHECK((c.a == Eigen::Array2d{8.5, 10.5}).all());
}

TEST_CASE_TEMPLATE("a state is finite when each of its numbers is", Scalar, float, double, long double) {
  using State = ToolState<3, Scalar>;
  const Scalar largest = std::numeric_limits<Scalar>::max(), infinity = std::numeric_limits<Scalar>::infinity();
  State state;
  for (auto State::*part : {&State::x, &State::v, &State::a, &State::force}) (state.*part).setConstant(largest);
  CHECK(is_finite(state));
  for (auto State::*part : {&State::x, &State::v, &State::a, &State::force}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const Scalar bad : {infinity, -infinity, std::numeric_limits<Scalar>::quiet_NaN()}) {
        State spoilt = state;
        (spoilt.*part)[axis] = bad;
        CHECK_FALSE(is_finite(spoilt));
      }
    }
  }
}
