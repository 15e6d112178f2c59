// SPDX-License-Identifier: MIT
#include <limpid/prediction/gains.hpp>

#include <doctest/doctest.h>

#include <limits>

using limpid::ConstantGain;
using limpid::ScheduledGain;
using limpid::Status;
using One = Eigen::Array<double, 1, 1>;

static_assert(limpid::PredictorGain<ConstantGain<3, float>, 3, float>);
static_assert(limpid::PredictorGain<ScheduledGain<2>, 2, double>);
static_assert(!limpid::PredictorGain<ConstantGain<3>, 2, double>);
static_assert(!limpid::PredictorGain<double, 1, double>);

namespace {

ScheduledGain<1>::Settings schedule() {
  return {.L0 = {-100.0, -4.0},
          .L1 = {0.5, 0.25},
          .L2 = {2.0, -0.125},
          .lower = {One::Constant(200), One::Constant(20)},
          .upper = {One::Constant(2000), One::Constant(40)}};
}

limpid::Tangents<1> rho(double k, double b) { return {One::Constant(k), One::Constant(b)}; }

}  // namespace

TEST_CASE("a constant gain weighs both errors, alike on every axis or each by its own") {
  using Two = Eigen::Array2d;
  const Two x(1, 2), v(10, 20);
  CHECK((ConstantGain<2>(3.0, 0.5).row()(x, v) == Two(8, 16)).all());
  CHECK((ConstantGain<2>(Two(3, 0), Two(0.5, 1)).row()(x, v) == Two(8, 20)).all());
  CHECK((ConstantGain<2>().row()(x, v) == Two::Zero()).all());
}

TEST_CASE("a scheduled gain is affine in stiffness and damping") {
  ScheduledGain<1> gain(schedule());
  CHECK(gain.update(0.0, rho(800, 32)) == Status::ok);  // exact in binary
  CHECK(gain.row().L1[0] == -100 + 0.5 * 800 + 2 * 32);
  CHECK(gain.row().L2[0] == -4 + 0.25 * 800 - 0.125 * 32);
}

TEST_CASE("beyond the box it was designed for the schedule stands on its face") {
  ScheduledGain<1> gain(schedule());
  CHECK(gain.update(0.0, rho(5000, 10)) == Status::at_bound);
  CHECK(gain.row().L1[0] == -100 + 0.5 * 2000 + 2 * 20);
}

TEST_CASE("a schedule by what is not finite, or back in time, changes nothing") {
  auto settings = schedule();
  settings.rate = rho(1000, 8);
  ScheduledGain<1> gain(settings), undisturbed(settings);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(gain.update(0.0, rho(nan, 30)) == Status::not_finite);
  CHECK((gain.row().L1 == 0).all());
  for (auto* each : {&gain, &undisturbed}) CHECK(each->update(0.0, rho(1000, 30)) == Status::ok);
  CHECK(gain.update(0.125, rho(1000, nan)) == Status::not_finite);
  CHECK(gain.update(nan, rho(500, 30)) == Status::not_finite);
  CHECK(gain.update(-0.125, rho(500, 30)) == Status::clock_backwards);
  for (auto* each : {&gain, &undisturbed}) CHECK(each->update(0.125, rho(500, 30.5)) == Status::at_bound);
  CHECK(gain.row().L1[0] == undisturbed.row().L1[0]);
  CHECK(gain.row().L2[0] == undisturbed.row().L2[0]);
}

TEST_CASE("without a limit of rate a schedule moves in no time") {
  ScheduledGain<1> gain(schedule());
  CHECK(gain.update(0.0, rho(1000, 30)) == Status::ok);
  CHECK(gain.update(0.0, rho(500, 25)) == Status::ok);
  CHECK(gain.row().L1[0] == -100 + 0.5 * 500 + 2 * 25);
}

TEST_CASE("the schedule moves no faster than the design allows, but starts anywhere") {
  auto settings = schedule();
  settings.rate = rho(1000, 8);
  ScheduledGain<1> gain(settings);
  CHECK(gain.update(0.0, rho(1000, 30)) == Status::ok);
  CHECK(gain.update(0.125, rho(500, 30.5)) == Status::at_bound);
  CHECK(gain.row().L1[0] == -100 + 0.5 * 875 + 2 * 30.5);
  CHECK(gain.update(0.5, rho(500, 30.5)) == Status::ok);
  CHECK(gain.row().L1[0] == -100 + 0.5 * 500 + 2 * 30.5);
}

TEST_CASE("impossible gains are refused") {
  CHECK_THROWS_WITH_AS(ConstantGain<1>(std::numeric_limits<double>::infinity(), 0.0).check(),
                       "ConstantGain: L1: expected finite, got inf", std::invalid_argument);
  auto empty = schedule();
  empty.upper.damping.setConstant(10);
  CHECK_THROWS_WITH_AS(ScheduledGain<1>(empty).check(),
                       "ScheduledGain: upper damping: expected finite and >= lower, got 10", std::invalid_argument);
  auto still = schedule();
  still.rate.stiffness.setZero();
  CHECK_THROWS_WITH_AS(ScheduledGain<1>(still).check(), "ScheduledGain: rate stiffness: expected > 0, got 0",
                       std::invalid_argument);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  auto broken = schedule();
  broken.L0 = {-500.0, nan};
  CHECK_THROWS_WITH_AS(ScheduledGain<1>(broken).check(), "ScheduledGain: L0.L2: expected finite, got nan",
                       std::invalid_argument);
  broken = schedule();
  broken.upper.stiffness.setConstant(nan);
  CHECK_THROWS_WITH_AS(ScheduledGain<1>(broken).check(),
                       "ScheduledGain: upper stiffness: expected finite and >= lower, got nan", std::invalid_argument);
  auto huge = schedule();
  huge.L1 = {0.5, 1e306};  // times 2000 N/m
  CHECK_THROWS_WITH_AS(ScheduledGain<1>(huge).check(),
                       "ScheduledGain: L0, L1, L2: expected a finite L2 all over the box, got inf",
                       std::invalid_argument);
}
