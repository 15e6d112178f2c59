// SPDX-License-Identifier: MIT
#include <limpid/estimation/excitation.hpp>
#include <support/no_allocation.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using limpid::ExcitationMonitor;
using limpid::Status;

namespace {

using Monitor = ExcitationMonitor<2>;
using Row = Monitor::Regressor;

}  // namespace

// Over a whole period the integral of (sin, cos)(sin, cos)' is half the period times I.
TEST_CASE("a circle excites both directions by half its period") {
  Monitor monitor({.window = 1, .least = 0.4});
  Monitor::Output output{};
  for (int k = 0; k < 2000; ++k) {
    const double angle = 2 * M_PI * k / 500;
    output = monitor.update(0.001, Row(std::sin(angle), std::cos(angle)));
  }
  // the window holds between 31/32 of T_1 and T_1, and the circle's period is T_1 / 2
  CHECK(output.least[0] > 0.5 * 31 / 32 - 0.02);
  CHECK(output.least[0] < 0.5 + 1e-12);
  CHECK(output.excited[0]);
}

TEST_CASE("a constant regressor excites one direction only") {
  Monitor monitor({.window = 1, .least = 1e-9});
  for (int k = 0; k < 2000; ++k) (void)monitor.update(0.001, Row(0.5, 0.25));
  const auto output = monitor.update(0.001, Row(0.5, 0.25));
  CHECK_FALSE(output.excited[0]);
  CHECK(output.least[0] < 1e-13);  // 0 to roundings of a Gramian of size 0.3
}

TEST_CASE("what lies longer ago than the window is forgotten, without a trace") {
  Monitor monitor({.window = 1, .least = 1e-9});
  for (int k = 0; k < 500; ++k) (void)monitor.update(0.001, Row(1e6 * std::sin(k), 1e6 * std::cos(k)));
  for (int k = 0; k < 1050; ++k) (void)monitor.update(0.001, Row::Zero());
  CHECK(monitor.gramian(0).isZero(0));
}

TEST_CASE("before the window is full, what was seen so far counts") {
  Monitor monitor({.window = 1, .least = 0.0009});
  CHECK_FALSE(monitor.update(0.001, Row(1, 0)).excited[0]);
  CHECK(monitor.update(0.001, Row(0, 1)).excited[0]);
  CHECK(monitor.update(0.001, Row(0, 0)).least[0] == doctest::Approx(0.001).epsilon(1e-14));
}

TEST_CASE("the window never holds more than its length, whatever the ticks") {
  ExcitationMonitor<1, 2, double, 4> monitor({.window = 0.5, .least = 1e-9});
  for (const double dt : {0.1, 0.01, 0.3, 2.0, 0.07, 0.5, 0.001, 0.2}) {
    const auto output = monitor.update(dt, Eigen::Array<double, 2, 1>(1, 2));
    CHECK(output.least[0] <= 0.5 * (1 + 1e-14));
    CHECK(output.least[1] <= 2 * (1 + 1e-14));
  }
}

TEST_CASE("what is not finite, or does not advance, is not added") {
  Monitor monitor({.window = 1, .least = 1e-9});
  (void)monitor.update(0.5, Row(1, 2));
  const auto gramian = monitor.gramian(0);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200}) {
    CHECK(monitor.update(0.1, Row(bad, 1)).status == Status::not_finite);
    CHECK(monitor.update(0.1, Row(1, bad)).status == Status::not_finite);
  }
  CHECK(monitor.update(std::numeric_limits<double>::quiet_NaN(), Row(1, 1)).status == Status::not_finite);
  CHECK(monitor.update(0, Row(1, 1)).status == Status::clock_backwards);
  CHECK(monitor.gramian(0) == gramian);
}

TEST_CASE("an update asks for no memory") {
  ExcitationMonitor<3, 3, float> monitor({.window = 1, .least = 1e-6F});
  limpid::test::check_no_allocation([&] {
    for (int k = 0; k < 100; ++k)
      (void)monitor.update(0.02F, ExcitationMonitor<3, 3, float>::Regressor::Constant(0.1F));
  });
}

TEST_CASE("impossible settings are refused with their values") {
  CHECK_THROWS_WITH_AS(Monitor({.window = 0, .least = 1}), "ExcitationMonitor: window: expected finite and > 0, got 0",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Monitor({.window = 1, .least = 0}), "ExcitationMonitor: least: expected finite and > 0, got 0",
                       std::invalid_argument);  // roundings would pass for excitation
  CHECK_THROWS_WITH_AS(Monitor({.window = 1}), "ExcitationMonitor: least: expected finite and > 0, got nan",
                       std::invalid_argument);
}
