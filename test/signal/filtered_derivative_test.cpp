// SPDX-License-Identifier: MIT
#include <limpid/signal/filtered_derivative.hpp>
#include <support/maximum.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using limpid::FilteredDerivative;
using limpid::Status;
using limpid::Time;
using limpid::test::maximum;
using namespace std::chrono_literals;

namespace {

template <typename Scalar>
using One = Eigen::Array<Scalar, 1, 1>;

}  // namespace

TEST_CASE("the first call gives zero, whatever the input") {
  FilteredDerivative<2> derivative;
  CHECK((derivative.update(5ms, {1e6, -3}).value == 0).all());
}

TEST_CASE_TEMPLATE("of a ramp of slope m it gives m (1 - exp(-t/tau)), over regular and irregular ticks", Scalar, float,
                   double, long double) {
  FilteredDerivative<1, Scalar> derivative({.time_constant = Scalar(0.0398)});
  std::mt19937 random(18120618);
  std::uniform_int_distribution<int> step(1, 5'000'000);
  Time now = 1h;
  const Time start = now;
  (void)derivative.update(now, One<Scalar>(Scalar{0}));
  for (int tick = 0; tick < 300; ++tick) {
    CAPTURE(tick);
    now += tick < 100 ? Time(1ms) : Time(step(random));
    const Scalar t = limpid::in_seconds<Scalar>(now - start);
    const Scalar value = derivative.update(now, One<Scalar>(3 * t)).value[0];
    const Scalar exact = -3 * std::expm1(-t / Scalar(0.0398));
    // a tick of h adds h/tau of what it is wrong by: 3 t epsilon/h in the difference quotient, some 3 epsilon elsewhere
    REQUIRE(std::abs(value - exact) <=
            Scalar(tick + 1) * (3 * t / Scalar(0.0398) + 3) * std::numeric_limits<Scalar>::epsilon());
  }
}

TEST_CASE("a sine of 4 Hz comes out with the gain and the lag of (5.3)") {
  constexpr double omega = 2 * std::numbers::pi * 4, tau = 0.0398;
  FilteredDerivative<1> derivative({.time_constant = tau});
  double worst = 0;
  for (int tick = 0; tick < 3000; ++tick) {
    const double t = tick * 1e-3;
    const double value = derivative.update(tick * 1ms, One<double>(std::sin(omega * t))).value[0];
    const double gain = omega / std::hypot(1, omega * tau), lag = std::atan(omega * tau);
    // the transient is below exp(-2/tau) after two seconds
    if (tick > 2000) worst = maximum(worst, std::abs(value - gain * std::cos(omega * t - lag)) / gain);
  }
  // linear interpolation lowers a sine by (omega h)^2/12 = 5.3e-5 on average
  CHECK(worst < 6e-5);
}

TEST_CASE("where nothing is asked for the cut-off is 20 Hz") {
  const double tau = FilteredDerivative<1>::Settings{}.time_constant;
  CHECK(std::abs(2 * std::numbers::pi * 20 * tau - 1) < 5e-4);  // tau has three digits
}

TEST_CASE("an input that is not finite changes nothing") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  FilteredDerivative<2> derivative, undisturbed;
  for (auto* each : {&derivative, &undisturbed}) {
    (void)each->update(0ms, {0, 0});
    (void)each->update(1ms, {1, 2});
  }
  const Eigen::Array2d before = undisturbed.update(1ms, {0, 0}).value;  // refused: the clock stands
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    const auto [value, status] = derivative.update(2ms, {3, bad});
    CHECK((value == before).all());
    CHECK(status == Status::not_finite);
  }
  CHECK((derivative.update(3ms, {5, 4}).value == undisturbed.update(3ms, {5, 4}).value).all());
}

TEST_CASE("a jump too large for the scalar is refused like an input that is not finite") {
  FilteredDerivative<1> derivative;
  constexpr double largest = std::numeric_limits<double>::max();
  (void)derivative.update(0ms, One<double>(-largest));
  CHECK(derivative.update(1ms, One<double>(largest)).status == Status::not_finite);
  CHECK(derivative.update(2ms, One<double>(-largest)).value[0] == 0);
}

TEST_CASE("a clock that does not advance changes nothing") {
  FilteredDerivative<1> derivative;
  (void)derivative.update(1ms, One<double>(0));
  const double before = derivative.update(2ms, One<double>(1)).value[0];
  for (const Time now : {Time(2ms), Time(1ms)}) {
    const auto [value, status] = derivative.update(now, One<double>(7));
    CHECK(value[0] == before);
    CHECK(status == Status::clock_backwards);
  }
}

TEST_CASE("no call allocates") {
  FilteredDerivative<3> derivative;
  limpid::test::check_no_allocation([&] {
    for (int tick = 0; tick < 10; ++tick) (void)derivative.update(tick * tick * 1ms, Eigen::Array3d::Constant(tick));
  });
}

TEST_CASE("a time constant that cannot be one is refused") {
  CHECK_THROWS_WITH_AS(FilteredDerivative<1>({.time_constant = 0}),
                       "FilteredDerivative: time_constant: expected finite and > 0, got 0", std::invalid_argument);
  CHECK_THROWS_WITH_AS(FilteredDerivative<1>({.time_constant = std::numeric_limits<double>::infinity()}),
                       "FilteredDerivative: time_constant: expected finite and > 0, got inf", std::invalid_argument);
}

TEST_CASE_TEMPLATE("with a time constant far above the ticks a ramp is followed to roundings", Scalar, float, double) {
  FilteredDerivative<1, Scalar> derivative({.time_constant = Scalar(16)});
  for (int tick = 0; tick <= 1000; ++tick) {
    const Scalar value = derivative.update(tick * 1ms, One<Scalar>(Scalar(tick) / 1024)).value[0];  // exact inputs
    const long double exact = -std::expm1(-tick * 1e-3L / 16) * 1000 / 1024;
    REQUIRE(std::abs(value - exact) <= 2 * (tick + 2) * exact * std::numeric_limits<Scalar>::epsilon());
  }
}
