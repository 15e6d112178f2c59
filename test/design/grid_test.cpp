// SPDX-License-Identifier: MIT
#include <limpid/design/grid.hpp>

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>
#include <string>

using limpid::Grid;
using limpid::GridSide;
using limpid::Tissue;

TEST_CASE_TEMPLATE("the thesis's grid has 19 by 21 cells, ends included", Scalar, float, double, long double) {
  const Grid<Scalar> grid{{200, 100, 2000}, {20, 1, 40}};
  grid.check();
  CHECK(grid.rows() == 19);
  CHECK(grid.columns() == 21);
  CHECK(grid.size() == 399);
  CHECK(grid[0] == Tissue<Scalar>{200, 20});
  CHECK(grid[20] == Tissue<Scalar>{200, 40});
  CHECK(grid[21] == Tissue<Scalar>{300, 20});
  CHECK(grid[398] == Tissue<Scalar>{2000, 40});
}

TEST_CASE("a step without exact binary form loses no end") {
  for (int steps = 1; steps <= 2000; ++steps) {
    CAPTURE(steps);
    const GridSide<double> side{0, 0.1, 0.1 * steps};
    REQUIRE_NOTHROW(side.check());
    REQUIRE(side.size() == static_cast<std::size_t>(steps) + 1);
    REQUIRE(side[0] == 0);
    REQUIRE(side[side.size() - 1] == 0.1 * steps);
  }
}

TEST_CASE("values between the ends lie a step apart to rounding") {
  const GridSide<double> side{0.3, 0.1, 1.3};
  REQUIRE(side.size() == 11);
  for (std::size_t i = 0; i < 11; ++i) CHECK(side[i] == doctest::Approx(0.3 + 0.1 * double(i)).epsilon(1e-15));
}

TEST_CASE("a side may be one value") {
  const GridSide<double> side{30, 1, 30};
  REQUIRE_NOTHROW(side.check());
  CHECK(side.size() == 1);
  CHECK(side[0] == 30);
}

TEST_CASE("a side that does not lead from its first value to its last is refused by the field's name") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  struct {
    GridSide<double> side;
    const char* names;
  } const refused[] = {{{nan, 1, 2}, "first"}, {{0, 1, inf}, "last"}, {{2, 1, 1}, "last"},
                       {{0, 0, 1}, "step"},    {{0, -1, 1}, "step"},  {{0, nan, 1}, "step"},
                       {{0, 0.3, 1}, "step"},  {{0, 2, 1}, "step"},   {{0, 1e-9, 1}, "step"}};
  for (const auto& which : refused) {
    const GridSide<double> side = which.side;
    CAPTURE(side.first);
    CAPTURE(side.step);
    CAPTURE(side.last);
    std::string words;
    try {
      side.check();
    } catch (const std::invalid_argument& error) {
      words = error.what();
    }
    CHECK(words.find(std::string("GridSide: ") + which.names) != std::string::npos);
  }
}

TEST_CASE("the box of a grid is from its first corner to its last") {
  const auto box = Grid<double>{{200, 100, 2000}, {20, 1, 40}}.box();
  CHECK(box.lower == Tissue<double>{200, 20});
  CHECK(box.upper == Tissue<double>{2000, 40});
}

TEST_CASE("a side without end has no values, and a grid of more cells than any memory is refused") {
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(GridSide<double>{0, 1, inf}.size() == 0);
  CHECK(GridSide<double>{0, 1e-300, 1e300}.size() == 0);
  const Grid<double> vast{{0, 1, 999'999}, {0, 1, 999'999}};
  CHECK_THROWS_WITH_AS(vast.check(), "Grid: cells: expected a hundred million or fewer, got 1000000000000",
                       std::invalid_argument);
}
