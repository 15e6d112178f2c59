// SPDX-License-Identifier: MIT
#include <limpid/prediction/gain_table.hpp>

#include <doctest/doctest.h>

#include <support/no_allocation.hpp>

#include <limits>

using limpid::GainRow;
using limpid::GainTable;
using limpid::Status;
using One = Eigen::Array<double, 1, 1>;

static_assert(limpid::PredictorGain<GainTable<1>, 1, double>);
static_assert(limpid::PredictorGain<GainTable<3, float>, 3, float>);
static_assert(!limpid::PredictorGain<GainTable<3>, 2, double>);

namespace {

// Powers of two: every mean below is exact.
GainTable<1>::Settings table() {
  GainTable<1>::Settings settings;
  settings.stiffness_knots = {256, 512, 1024};
  settings.damping_knots = {16, 32};
  settings.L = {{-8.0, 1.0}, {-16.0, 2.0}, {-32.0, 4.0}, {-64.0, 8.0}, {-128.0, 16.0}, {-256.0, 32.0}};
  return settings;
}

limpid::Tangents<1> rho(double k, double b) { return {One::Constant(k), One::Constant(b)}; }

}  // namespace

TEST_CASE("at a knot a table gives the knot's gain") {
  const auto settings = table();
  GainTable<1> gain(settings);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      CHECK(gain.update(0.0, rho(settings.stiffness_knots[i], settings.damping_knots[j])) == Status::ok);
      CHECK(gain.row().L1[0] == settings.L[2 * i + j].L1[0]);
      CHECK(gain.row().L2[0] == settings.L[2 * i + j].L2[0]);
    }
  }
}

TEST_CASE("between knots a table is bilinear") {
  GainTable<1> gain(table());
  (void)gain.update(0.0, rho(384, 24));  // the middle of the first cell: the mean of its corners
  CHECK(gain.row().L1[0] == (-8.0 - 16 - 32 - 64) / 4);
  CHECK(gain.row().L2[0] == (1.0 + 2 + 4 + 8) / 4);
  (void)gain.update(0.0, rho(640, 16));  // a quarter of the second cell's edge
  CHECK(gain.row().L1[0] == -32 * 0.75 - 128 * 0.25);
}

TEST_CASE("a table of an affine gain is that gain") {
  using limpid::ScheduledGain;
  const ScheduledGain<1>::Settings affine{
      .L0 = {-100.0, -4.0}, .L1 = {0.5, 0.25}, .L2 = {2.0, -0.125}, .lower = rho(256, 16), .upper = rho(1024, 32)};
  ScheduledGain<1> expected(affine);
  auto settings = table();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      (void)expected.update(0.0, rho(settings.stiffness_knots[i], settings.damping_knots[j]));
      settings.L[2 * i + j] = expected.row();
    }
  }
  GainTable<1> gain(settings);
  expected = ScheduledGain<1>(affine);
  for (const auto& [k, b] : {std::pair{300.0, 17.0}, {511.0, 31.0}, {1000.0, 20.0}, {2000.0, 5.0}}) {
    CHECK(gain.update(1.0, rho(k, b)) == expected.update(1.0, rho(k, b)));
    CHECK(gain.row().L1[0] == doctest::Approx(expected.row().L1[0]).epsilon(1e-13));  // a dozen roundings
    CHECK(gain.row().L2[0] == doctest::Approx(expected.row().L2[0]).epsilon(1e-13));
  }
}

TEST_CASE("beyond its knots a table stands on its edge, and it moves no faster than allowed") {
  auto settings = table();
  settings.rate = rho(1024, 8);
  GainTable<1> gain(settings);
  CHECK(gain.update(0.0, rho(5000, 40)) == Status::at_bound);
  CHECK(gain.row().L1[0] == -256);
  CHECK(gain.update(0.25, rho(512, 32)) == Status::at_bound);  // as far as 768
  CHECK(gain.row().L1[0] == (-64.0 - 256) / 2);
  CHECK(gain.update(0.25, rho(512, 32)) == Status::ok);
  CHECK(gain.row().L1[0] == -64);
}

TEST_CASE("each axis is scheduled by its own tissue") {
  GainTable<2>::Settings settings;
  settings.stiffness_knots = {0, 4};
  settings.damping_knots = {0, 4};
  settings.L = {{0.0, 0.0}, {4.0, 0.0}, {16.0, 0.0}, {20.0, 0.0}};
  GainTable<2> gain(settings);
  (void)gain.update(0.0, {Eigen::Array2d(1, 3), Eigen::Array2d(2, 4)});
  CHECK((gain.row().L1 == Eigen::Array2d(4 * 1 + 2, 4 * 3 + 4)).all());
}

TEST_CASE("a table is updated without allocation, and by default gives no feedback") {
  GainTable<1> gain(table());
  limpid::test::check_no_allocation([&] {
    for (int i = 0; i < 100; ++i) (void)gain.update(0.001, rho(200 + 10 * i, 15 + 0.2 * i));
  });
  GainTable<3> none;
  (void)none.update(0.0, {Eigen::Array3d::Constant(1000), Eigen::Array3d::Constant(30)});
  CHECK((none.row().L1 == 0).all());
}

TEST_CASE("a table asked for what is not finite, or back in time, keeps its gain") {
  GainTable<1> gain(table());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(gain.update(0.0, rho(nan, 16)) == Status::not_finite);
  CHECK((gain.row().L1 == 0).all());
  CHECK(gain.update(0.0, rho(256, 16)) == Status::ok);
  CHECK(gain.update(0.125, rho(512, nan)) == Status::not_finite);
  CHECK(gain.update(-0.125, rho(512, 32)) == Status::clock_backwards);
  CHECK(gain.row().L1[0] == -8);
  CHECK(gain.row().L2[0] == 1);
}

TEST_CASE("impossible tables are refused") {
  auto falling = table();
  falling.stiffness_knots = {512, 256, 1024};
  CHECK_THROWS_WITH_AS(GainTable<1>{falling}, "GainTable: stiffness_knots: expected finite and rising, got 256",
                       std::invalid_argument);
  auto narrow = table();
  narrow.damping_knots = {16};
  CHECK_THROWS_WITH_AS(GainTable<1>{narrow}, "GainTable: damping_knots: expected two or more, got 1",
                       std::invalid_argument);
  auto missing = table();
  missing.L.pop_back();
  CHECK_THROWS_WITH_AS(GainTable<1>{missing}, "GainTable: L: expected a row for each knot, got 5",
                       std::invalid_argument);
  auto not_finite = table();
  not_finite.L[0].L1.setConstant(std::numeric_limits<double>::quiet_NaN());
  CHECK_THROWS_WITH_AS(GainTable<1>{not_finite}, "GainTable: L[0].L1: expected finite, got nan", std::invalid_argument);
  not_finite = table();
  not_finite.L[3].L2.setConstant(std::numeric_limits<double>::infinity());
  CHECK_THROWS_WITH_AS(GainTable<1>{not_finite}, "GainTable: L[3].L2: expected finite, got inf", std::invalid_argument);
  auto still = table();
  still.rate.damping.setZero();
  CHECK_THROWS_WITH_AS(GainTable<1>{still}, "GainTable: rate damping: expected > 0, got 0", std::invalid_argument);
}
