// SPDX-License-Identifier: MIT
#include <limpid/core/dormand_prince.hpp>

#include <support/no_allocation.hpp>
#include <support/precision.hpp>

#include <doctest/doctest.h>

#include <limits>

using limpid::DormandPrince;
using limpid::Status;
using limpid::test::Fifty;

namespace {

template <typename Scalar>
using Pair = Eigen::Array<Scalar, 2, 1>;

constexpr auto oscillate = [](const auto&, const auto& y) {
  return std::decay_t<decltype(y)>(y[1], -y[0]);  // y = (cos t, -sin t)
};

}  // namespace

TEST_CASE_TEMPLATE("a circle is followed within the tolerance a radian", Scalar, float, double, long double) {
  const DormandPrince<Pair<Scalar>> integrator;
  Pair<Scalar> y(1, 0);
  CHECK(integrator.advance(y, Scalar(0), Scalar(10), oscillate) == Status::ok);
  const Scalar relative = typename DormandPrince<Pair<Scalar>>::Settings{}.relative;
  using std::abs, std::cos, std::sin;
  CHECK(abs(y[0] - cos(Scalar(10))) < 10 * relative);  // local errors of less than `relative` a step of some 0.1 rad,
  CHECK(abs(y[1] + sin(Scalar(10))) < 10 * relative);  // which do not grow; steps err less than they may
}

TEST_CASE("in 50 digits the answer keeps the digits asked for") {
  const DormandPrince<Pair<Fifty>> integrator({.absolute = Fifty(1e-22), .relative = Fifty(1e-22)});
  Pair<Fifty> y(1, 0);
  CHECK(integrator.advance(y, Fifty(0), Fifty(1) / 8, oscillate) == Status::ok);
  CHECK(abs(y[0] - cos(Fifty(1) / 8)) < Fifty(1e-20));  // fewer than a hundred steps of 1e-22
  CHECK(abs(y[1] + sin(Fifty(1) / 8)) < Fifty(1e-20));
}

TEST_CASE("a polynomial of degree five in time is exact: all seven stages stand at their own instants") {
  using One = Eigen::Array<double, 1, 1>;
  const DormandPrince<One> integrator;
  One y(2.0);
  CHECK(integrator.advance(y, 1.0, 2.0, [](double t, const One&) { return One(6 * t * t * t * t * t - 4 * t); }) ==
        Status::ok);
  CHECK(std::abs(y[0] - (2.0 + 63.0 - 6.0)) < 1e-9 * 59);  // degree six by a pair of order five: the tolerance
  y[0] = 2.0;
  CHECK(integrator.advance(y, 1.0, 2.0, [](double t, const One&) { return One(5 * t * t * t * t); }) == Status::ok);
  CHECK(std::abs(y[0] - 33.0) < 8 * 33 * std::numeric_limits<double>::epsilon());  // rounding alone
}

TEST_CASE("halving a single forced step divides its error by 32 to 64: order five") {
  const DormandPrince<Pair<Fifty>> one_step({.absolute = Fifty(1), .relative = Fifty(1)});  // accepts at once
  const auto error = [&](const Fifty& h) {
    Pair<Fifty> y(1, 0);
    CHECK(one_step.advance(y, Fifty(0), h, oscillate) == Status::ok);
    return Fifty(abs(y[0] - cos(h)) + abs(y[1] + sin(h)));
  };
  const Fifty ratio = error(Fifty(1) / 64) / error(Fifty(1) / 128);
  CHECK(ratio > 62);  // the local error is of order six, up to a term one order higher: h = 1/64
  CHECK(ratio < 66);
}

TEST_CASE("time that does not advance changes nothing") {
  const DormandPrince<Pair<double>> integrator;
  Pair<double> y(1, 0);
  CHECK(integrator.advance(y, 3.0, 3.0, oscillate) == Status::ok);
  CHECK(integrator.advance(y, 3.0, 2.0, oscillate) == Status::clock_backwards);
  CHECK((y == Pair<double>(1, 0)).all());
}

TEST_CASE("a non-finite state, time or slope leaves the state untouched and says so") {
  const DormandPrince<Pair<double>> integrator;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Pair<double> y(1, 0);
    CHECK(integrator.advance(y, bad, 1.0, oscillate) == Status::not_finite);
    CHECK(integrator.advance(y, 0.0, bad, oscillate) == Status::not_finite);
    CHECK(integrator.advance(y, 0.0, 1.0, [&](double, const Pair<double>& at) { return Pair<double>(at[0], bad); }) ==
          Status::not_finite);
    CHECK(integrator.advance(y, 0.0, 1.0, [&](double t, const Pair<double>& at) {
      return Pair<double>(at[0], t > 0.5 ? bad : 0.0);
    }) == Status::not_finite);
    CHECK((y == Pair<double>(1, 0)).all());
    y[0] = bad;
    CHECK(integrator.advance(y, 0.0, 1.0, oscillate) == Status::not_finite);
    CHECK(y[1] == 0.0);
  }
}

TEST_CASE("a state that runs away and one that is too stiff are given up, untouched") {
  using One = Eigen::Array<double, 1, 1>;
  const DormandPrince<One> integrator({.most_steps = 500});
  One y(1.0);  // y = 1/(1 - t): no state at t = 1
  CHECK(integrator.advance(y, 0.0, 2.0, [](double, const One& at) { return One(at * at); }) != Status::ok);
  CHECK(y[0] == 1.0);
  CHECK(integrator.advance(y, 0.0, 1.0, [](double, const One& at) { return One(-1e6 * at); }) == Status::limited);
  CHECK(y[0] == 1.0);
}

TEST_CASE("matrices are states too, and no step allocates") {
  const DormandPrince<Eigen::Matrix2d> integrator;
  Eigen::Matrix2d rotation = Eigen::Matrix2d::Identity(), turn;
  turn << 0, -1, 1, 0;
  Status status = Status::fault;
  limpid::test::check_no_allocation([&] {
    status = integrator.advance(rotation, 0.0, 1.0,
                                [&](double, const Eigen::Matrix2d& R) { return Eigen::Matrix2d(turn * R); });
  });
  CHECK(status == Status::ok);
  CHECK(std::abs(rotation(1, 0) - std::sin(1.0)) < 1e-9);  // ten times the tolerance
}

TEST_CASE("settings that cannot serve are refused with the field's name") {
  using Integrator = DormandPrince<Pair<double>>;
  CHECK_THROWS_WITH_AS(Integrator({.absolute = 0.0}), "DormandPrince: absolute: expected finite and > 0, got 0",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Integrator({.relative = -1.0}), "DormandPrince: relative: expected finite and >= 0, got -1",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Integrator({.most_steps = 0}), "DormandPrince: most_steps: expected > 0, got 0",
                       std::invalid_argument);
}
