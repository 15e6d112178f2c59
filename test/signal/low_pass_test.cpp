// SPDX-License-Identifier: MIT
#include <limpid/signal/low_pass.hpp>
#include <support/maximum.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using limpid::LowPass;
using limpid::Status;
using limpid::Time;
using limpid::test::maximum;
using namespace std::chrono_literals;

namespace {

template <typename Scalar>
using One = Eigen::Array<Scalar, 1, 1>;

}  // namespace

TEST_CASE("it starts at rest at the first input and stays there") {
  LowPass<2> filter({.cutoff = 4});
  for (int tick = 3; tick < 20; ++tick)
    CHECK((filter.update(tick * 1ms, {5, -2}).value == Eigen::Array2d{5, -2}).all());
}

TEST_CASE_TEMPLATE("a ramp is followed tau behind, exactly, over irregular ticks", Scalar, float, double, long double) {
  const Scalar tau = Scalar(0.04);
  LowPass<1, Scalar> filter({.cutoff = Scalar(1 / (2 * std::numbers::pi_v<long double>)) / tau});
  std::mt19937 random(18151012);
  std::uniform_int_distribution<int> step(1, 5'000'000);
  Time now{};
  (void)filter.update(now, One<Scalar>(Scalar{0}));
  for (int tick = 0; tick < 400; ++tick) {
    CAPTURE(tick);
    now += Time(step(random));
    const Scalar t = limpid::in_seconds<Scalar>(now);
    const Scalar exact = t + tau * std::expm1(-t / tau);
    // a few roundings of values below 1.2 s at each of the 400 ticks, which the filter forgets but may add up till then
    REQUIRE(std::abs(filter.update(now, One<Scalar>(t)).value[0] - exact) <=
            400 * std::numeric_limits<Scalar>::epsilon());
  }
}

TEST_CASE("at the cutoff the gain is 1/sqrt(2) and the lag an eighth of a turn") {
  LowPass<1> filter({.cutoff = 10});
  double worst = 0;
  for (int tick = 0; tick < 2000; ++tick) {
    const double angle = 2 * std::numbers::pi * 10 * tick * 1e-3;
    const double value = filter.update(tick * 1ms, One<double>(std::sin(angle))).value[0];
    // the transient is below exp(-2 pi 10) after a second
    if (tick > 1000) {
      worst = maximum(worst, std::abs(value * std::numbers::sqrt2 - std::sin(angle - std::numbers::pi / 4)));
    }
  }
  // linear interpolation lowers a sine by (omega h)^2/12 = 3.3e-4 on average
  CHECK(worst < 3.6e-4);
}

TEST_CASE("an input that is not finite changes nothing") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  LowPass<2> filter({.cutoff = 4}), undisturbed({.cutoff = 4});
  CHECK((filter.update(0ms, {infinity, 1}).value == 0).all());  // not yet started
  for (auto* each : {&filter, &undisturbed}) (void)each->update(0ms, {1, 2});
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    const auto [value, status] = filter.update(1ms, {3, bad});
    CHECK((value == Eigen::Array2d{1, 2}).all());
    CHECK(status == Status::not_finite);
  }
  CHECK((filter.update(3ms, {5, 4}).value == undisturbed.update(3ms, {5, 4}).value).all());
}

TEST_CASE("a jump too large for the scalar is refused like an input that is not finite") {
  LowPass<1> filter({.cutoff = 4});
  constexpr double largest = std::numeric_limits<double>::max();
  (void)filter.update(0ms, One<double>(-largest));
  const auto [value, status] = filter.update(1ms, One<double>(largest));
  CHECK(value[0] == -largest);
  CHECK(status == Status::not_finite);
}

TEST_CASE("a clock that does not advance changes nothing") {
  LowPass<1> filter({.cutoff = 4});
  (void)filter.update(2ms, One<double>(1));
  for (const Time now : {Time(2ms), Time(1ms)}) {
    const auto [value, status] = filter.update(now, One<double>(7));
    CHECK(value[0] == 1);
    CHECK(status == Status::clock_backwards);
  }
}

TEST_CASE("no call allocates") {
  LowPass<3> filter({.cutoff = 4});
  limpid::test::check_no_allocation([&] {
    for (int tick = 0; tick < 10; ++tick) (void)filter.update(tick * tick * 1ms, Eigen::Array3d::Constant(tick));
  });
}

TEST_CASE("a cutoff that cannot be one is refused") {
  CHECK_THROWS_WITH_AS(LowPass<1>({.cutoff = 0}), "LowPass: cutoff: expected finite and > 0, got 0",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(LowPass<1>({.cutoff = -std::numeric_limits<double>::infinity()}),
                       "LowPass: cutoff: expected finite and > 0, got -inf", std::invalid_argument);
}

// The step's 1 - (1 - exp(-a))/a is of size a/2 = 3e-5 here: as a difference it would be off by 6e-3 of itself.
TEST_CASE_TEMPLATE("at a cutoff far below the ticks a ramp is followed to roundings", Scalar, float, double) {
  const long double tau = 100 / (2 * std::numbers::pi_v<long double>);
  LowPass<1, Scalar> filter({.cutoff = Scalar(0.01)});
  for (int tick = 0; tick <= 1000; ++tick) {
    const Scalar value = filter.update(tick * 1ms, One<Scalar>(Scalar(tick) / 1024)).value[0];  // exact inputs
    const long double t = tick * 1e-3L, exact = (t + tau * std::expm1(-t / tau)) * 1000 / 1024;
    // each tick rounds the value so far twice, and its own part of it a few times
    REQUIRE(std::abs(value - exact) <= 2 * (tick + 2) * exact * std::numeric_limits<Scalar>::epsilon());
  }
}
