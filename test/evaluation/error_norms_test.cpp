// SPDX-License-Identifier: MIT
#include <limpid/evaluation/error_norms.hpp>

#include "support/no_allocation.hpp"
#include "support/precision.hpp"

#include <Eigen/Core>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

using limpid::ErrorNorms;
using limpid::Status;
using limpid::Time;
using namespace std::chrono_literals;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE_TEMPLATE("a constant error has its length as maximum, and times the root of the duration as L2 norm", Scalar,
                   float, double, long double, limpid::test::Fifty) {
  using std::abs, std::sqrt;
  using Vector = Eigen::Array<Scalar, 2, 1>;
  ErrorNorms<2, Scalar> norms;
  for (Time now = 0ns; now <= 2s; now += 125ms)
    norms.add(now, Vector(Scalar(3), Scalar(0)), Vector(Scalar(0), Scalar(4)));
  const Scalar rounding =
      4 * std::numeric_limits<Scalar>::epsilon();  // 125 ms is exact: the roots' own, of values below 8
  CHECK(norms.total().max == Scalar(5));
  CHECK(norms.position().max == Scalar(3));
  CHECK(norms.velocity().max == Scalar(4));
  CHECK(abs(norms.total().l2 - 5 * sqrt(Scalar(2))) <= rounding);
  CHECK(abs(norms.position().l2 - 3 * sqrt(Scalar(2))) <= rounding);
  CHECK(abs(norms.velocity().l2 - 4 * sqrt(Scalar(2))) <= rounding);
}

TEST_CASE("a sine over whole periods has the L2 norm A sqrt(T/2)") {
  // The trapezoidal rule is exact for sin^2 over whole periods. 1000 rounded squares leave at most 1000 eps.
  ErrorNorms<> norms;
  for (int i = 0; i <= 1000; ++i) {
    const double e = 0.25 * std::sin(2 * std::numbers::pi * 4 * i / 1000);
    norms.add(Time{i * 1'000'000}, Eigen::Array<double, 1, 1>(e), Eigen::Array<double, 1, 1>(0));
  }
  CHECK(std::abs(norms.total().l2 - 0.25 * std::sqrt(0.5)) < 1000 * std::numeric_limits<double>::epsilon());
  CHECK(norms.velocity().l2 == 0);
}

TEST_CASE("with irregular ticks the integral is the trapezoidal rule's") {
  // e = t: the rule exceeds the integral t^3/3 by h^3/6 on each step of length h.
  ErrorNorms<> norms;
  double excess = 0;
  Time now{};
  for (const auto h : {0ms, 125ms, 500ms, 250ms, 125ms}) {
    now += h;
    const double t = limpid::in_seconds(now), step = limpid::in_seconds(h);
    norms.add(now, Eigen::Array<double, 1, 1>(0), Eigen::Array<double, 1, 1>(t));
    excess += step * step * step / 6;
  }
  CHECK(std::abs(norms.velocity().l2 - std::sqrt(1.0 / 3 + excess)) <= 4 * std::numeric_limits<double>::epsilon());
}

TEST_CASE("one tick has a maximum and no integral") {
  ErrorNorms<> norms;
  norms.add(7s, Eigen::Array<double, 1, 1>(-2), Eigen::Array<double, 1, 1>(0));
  CHECK(norms.total().max == 2);
  CHECK(norms.total().l2 == 0);
}

TEST_CASE("a float counts a million ticks") {
  ErrorNorms<1, float> norms;
  for (int i = 0; i <= 1'000'000; ++i) {
    norms.add(i * 1ms, Eigen::Array<float, 1, 1>(1), Eigen::Array<float, 1, 1>(0));
  }
  // Rounding of 1 ms, the same at each tick, of the compensated sum, and of the root: 2 eps.
  CHECK(std::abs(norms.total().l2 / std::sqrt(1000.0F) - 1.0F) <= 2 * std::numeric_limits<float>::epsilon());
}

TEST_CASE("a non-finite axis leaves the tick out and says so") {
  ErrorNorms<2> norms;
  norms.add(0s, Eigen::Array2d(1, 0), Eigen::Array2d(0, 0));
  for (const double bad : {nan_value, infinity, -infinity}) {
    CAPTURE(bad);
    for (int axis = 0; axis < 2; ++axis) {
      CAPTURE(axis);
      Eigen::Array2d good(5, 5), wrong(5, 5);
      wrong[axis] = bad;
      CHECK(norms.add(500ms, wrong, good) == Status::not_finite);
      CHECK(norms.add(500ms, good, wrong) == Status::not_finite);
    }
  }
  CHECK(norms.add(1s, Eigen::Array2d(1, 0), Eigen::Array2d(0, 0)) == Status::ok);
  CHECK(norms.total().max == 1);
  CHECK(norms.total().l2 == 1);  // one step of 1 s
}

TEST_CASE("time that does not advance leaves the tick out and says so") {
  ErrorNorms<> norms;
  const Eigen::Array<double, 1, 1> one(1), nine(9);
  norms.add(1s, one, one * 0);
  CHECK(norms.add(1s, nine, nine) == Status::clock_backwards);
  CHECK(norms.add(0s, nine, nine) == Status::clock_backwards);
  CHECK(norms.add(2s, one, one * 0) == Status::ok);
  CHECK(norms.total().max == 1);
  CHECK(norms.total().l2 == 1);
}

TEST_CASE("matrices and arrays are taken alike, and nothing is allocated") {
  ErrorNorms<3> norms;
  const Eigen::Vector3d x(1, 2, 3), x_e(1, 2, 1);
  limpid::test::check_no_allocation([&] { norms.add(0s, x - x_e, (x_e - x_e).array()); });
  CHECK(norms.position().max == 2);
}

TEST_CASE("the relative change is negative where the prediction helps") {
  CHECK(limpid::relative_change(0.25, 1.0) == -0.75);
  CHECK(limpid::relative_change(3.0, 2.0) == 0.5);
  CHECK(limpid::relative_change(0.0, 0.0) == 0);
  CHECK(limpid::relative_change(1.0, 0.0) == infinity);
}

TEST_CASE("a change is significant above Weber's fraction of 7 %, for better or for worse") {
  CHECK(limpid::significant(-0.08));
  CHECK(limpid::significant(0.08F));
  CHECK_FALSE(limpid::significant(-0.06));
  CHECK_FALSE(limpid::significant(limpid::weber_threshold));
  CHECK_FALSE(limpid::significant(0.0));
}
