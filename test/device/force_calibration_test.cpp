// SPDX-License-Identifier: MIT
#include <limpid/device/force_calibration.hpp>

#include <support/no_allocation.hpp>

#include <Eigen/LU>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

using limpid::cross_talk;
using limpid::ForceCalibration;

namespace {

using Settings = ForceCalibration<>::Settings;
using Counts = std::array<std::int16_t, 3>;

Settings matrix(const Eigen::Matrix3d& newtons_per_count) {
  Settings settings;
  settings.newtons_per_count = newtons_per_count;
  return settings;
}

}  // namespace

TEST_CASE("counts become newtons by matrix and offset") {
  Eigen::Matrix3d M;
  M << 0.5, 0.25, 0, -0.125, 1, 2, 0, 0, 4;
  Settings settings = matrix(M);
  settings.offset << 10, 20, 30;
  const ForceCalibration<> calibration(settings);
  // M (2, 4, -2)
  CHECK(calibration.force(Counts{12, 24, 28}) == Eigen::Vector3d(2, -0.25, -8));
  CHECK(calibration.force(Eigen::Vector3d(10, 20, 30)) == Eigen::Vector3d(0, 0, 0));
}

TEST_CASE("the lever changes nothing at the flange, and at the thesis's handle takes its 2.89 off") {
  Settings settings = matrix(Eigen::Matrix3d::Identity());
  CHECK(ForceCalibration<>(settings).force(Counts{100, -100, 50}) == Eigen::Vector3d(100, -100, 50));
  settings.lever_arm = 0.073;
  const Eigen::Vector3d force = ForceCalibration<>(settings).force(Counts{100, -100, 50});
  CHECK((force - Eigen::Vector3d(100, -100, 50) / 3.89445).norm() < 1e-13);  // 1 + 39.65 * 0.073; roundings of 100
}

TEST_CASE("an axis that the lever does not touch keeps its force") {
  Settings settings = matrix(Eigen::Matrix3d::Identity());
  settings.lever_gain << 10, 20, 0;
  settings.lever_arm = 0.1;
  const Eigen::Vector3d force = ForceCalibration<>(settings).force(Counts{100, 300, 50});
  CHECK((force - Eigen::Vector3d(50, 100, 50)).norm() < 1e-13);
}

TEST_CASE("a newton is as many counts as the tables print") {
  const ForceCalibration<> maker(ForceCalibration<>::table_5_4()), measured(ForceCalibration<>::table_5_5());
  CHECK((maker.force(Eigen::Vector3d(955.53, 962.22, 162.44)) - Eigen::Vector3d::Ones()).norm() < 1e-15);
  CHECK((measured.force(Eigen::Vector3d(1087.4, -1089.1, 120.5)) - Eigen::Vector3d::Ones()).norm() < 1e-15);
}

TEST_CASE_TEMPLATE("other scalars calibrate, too", Scalar, float, long double) {
  const ForceCalibration<Scalar> measured(ForceCalibration<Scalar>::table_5_5());
  CHECK(std::abs(measured.force(Counts{0, 0, 241})[2] - Scalar(2)) < 4 * std::numeric_limits<Scalar>::epsilon());
}

TEST_CASE("cross-talk is the largest share of another axis's force") {
  Eigen::Matrix3d response;
  response << 1000, 50, 0, -70, -1000, 20, 90, 0, 100;
  CHECK(cross_talk(response) == 0.9);  // z shows 90 counts of a newton along x, which it would call 0.9 N
  CHECK(cross_talk(Eigen::Matrix3d::Identity().eval()) == 0);
  response(2, 2) = 0;
  CHECK(cross_talk(response) == std::numeric_limits<double>::infinity());
}

TEST_CASE("a calibration by the whole matrix has no cross-talk, one of the diagonal all of it") {
  Eigen::Matrix3d response;
  response << 1000, 50, 0, -70, -1000, 20, 90, 0, 100;
  CHECK(cross_talk((response.inverse() * response).eval()) < 1e-14);
  const Eigen::Matrix3d by_axis = Eigen::Matrix3d(response.diagonal().asDiagonal()).inverse();
  CHECK(cross_talk((by_axis * response).eval()) == doctest::Approx(0.9).epsilon(1e-15));
}

TEST_CASE("settings that are none of a sensor are refused by name") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), huge = std::numeric_limits<double>::max();
  CHECK_THROWS_AS(ForceCalibration<>(Settings{}), std::invalid_argument);  // the matrix has no default
  CHECK_THROWS_AS(ForceCalibration<>(matrix(Eigen::Matrix3d::Constant(huge / 1000))), std::invalid_argument);
  Settings settings = matrix(Eigen::Matrix3d::Identity());
  settings.offset[1] = nan;
  CHECK_THROWS_WITH_AS(ForceCalibration<>{settings},
                       "ForceCalibration: offset: expected counts of at most 65536 in magnitude, got 0 nan 0",
                       std::invalid_argument);
  settings = matrix(Eigen::Matrix3d::Identity());
  settings.lever_arm = -0.01;
  CHECK_THROWS_WITH_AS(ForceCalibration<>{settings}, "ForceCalibration: lever_arm: expected finite and >= 0, got -0.01",
                       std::invalid_argument);
  settings.lever_arm = 0.1;
  settings.lever_gain[2] = -10;
  CHECK_THROWS_WITH_AS(ForceCalibration<>{settings},
                       "ForceCalibration: lever_gain: expected finite, with 1 + a_m r > 0, got 39.65 39.65 -10",
                       std::invalid_argument);
}

TEST_CASE("a force does not allocate, and is finite for all counts") {
  const ForceCalibration<> calibration(ForceCalibration<>::table_5_5());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  limpid::test::check_no_allocation([&] {
    sum += calibration.force(Counts{-32768, 32767, -32768});
    sum += calibration.force(Counts{32767, -32768, 32767});
  });
  CHECK(sum.allFinite());
}
