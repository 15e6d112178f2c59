// SPDX-License-Identifier: MIT
#include <limpid/device/usb/omni_calibration.hpp>
#include <limpid/robot/omni.hpp>

#include "support/no_allocation.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>

using Eigen::Vector3d;
using limpid::OmniBridge, limpid::OmniCalibration;

namespace {

constexpr double pi = std::numbers::pi;
const OmniCalibration calibration{.full_scale = {0.4, 0.5, 0.2}};

std::array<std::uint16_t, 3> converters_of(const Vector3d& torque) {
  std::array<std::uint16_t, 3> converter{};
  (void)calibration.convert(torque, converter);
  return converter;
}

// What the converters make at the joints: u = 2 DAC/4095 - 1 of full scale, and (5.5).
Vector3d torque_of(const std::array<std::uint16_t, 3>& converter) {
  Vector3d command;
  for (std::size_t i = 0; i < 3; ++i) command[static_cast<int>(i)] = 2 * converter[i] / 4095.0 - 1;
  command = command.cwiseProduct(calibration.full_scale);
  return {-command[0], command[1], 1.43 * command[2]};
}

}  // namespace

TEST_CASE("a docked arm is at its home angles, by (5.1)") {
  const Vector3d q = calibration.joints({100, -200, 300}, {100, -200, 300});
  CHECK((q - Vector3d(0, 0.23, -0.37 - 0.23 - pi / 2)).norm() < 1e-15);
}

TEST_CASE("a docked arm is within the limits of its joints") {
  const Vector3d q = calibration.joints({0, 0, 0}, {0, 0, 0});
  const auto limits = limpid::Omni<>{}.limits();
  CHECK((q.array() >= limits.lower.array()).all());
  CHECK((q.array() <= limits.upper.array()).all());
}

TEST_CASE("counts turn the joints by (5.1): the first and the second against their sense, the third with both") {
  const double turn = 2 * pi / 15'000;
  const Vector3d home = calibration.joints({0, 0, 0}, {0, 0, 0});
  CHECK((calibration.joints({10, 0, 0}, {0, 0, 0}) - home - Vector3d(-10 * turn, 0, 0)).norm() < 1e-14);
  CHECK((calibration.joints({0, 10, 0}, {0, 0, 0}) - home - Vector3d(0, -10 * turn, 10 * turn)).norm() < 1e-14);
  CHECK((calibration.joints({0, 0, 10}, {0, 0, 0}) - home - Vector3d(0, 0, 10 * turn)).norm() < 1e-14);
}

TEST_CASE("counts may wrap between the dock and now") {
  const Vector3d wrapped = calibration.joints({-32'760, 0, 0}, {32'760, 0, 0});
  CHECK((wrapped - calibration.joints({16, 0, 0}, {0, 0, 0})).norm() < 1e-14);
}

TEST_CASE("no torque is 7ff on all converters") {
  CHECK(converters_of(Vector3d::Zero()) == OmniBridge::safe().converter);
  CHECK(converters_of(Vector3d::Constant(-0.0)) == OmniBridge::safe().converter);
}

TEST_CASE("converters give the torque that is asked for, to one step") {
  for (const Vector3d& torque : {Vector3d(0.1, -0.2, 0.05), Vector3d(-0.39, 0.49, -0.28), Vector3d(1e-3, -1e-3, 0)}) {
    const Vector3d error = torque_of(converters_of(torque)) - torque;
    CHECK((error.cwiseAbs().array() <= Vector3d(0.4, 0.5, 0.2 * 1.43).array() * 2 / 4095).all());
  }
}

TEST_CASE("more torque than there is keeps its direction") {
  std::array<std::uint16_t, 3> converter{};
  CHECK(calibration.convert({0.8, 0.1, 0}, converter) == doctest::Approx(0.5));
  CHECK((torque_of(converter) - Vector3d(0.4, 0.05, 0)).cwiseAbs().maxCoeff() < 0.5 * 2 / 4095);
  CHECK(calibration.convert({1e300, 0, 0}, converter) == doctest::Approx(4e-301));
  CHECK(converter == std::array<std::uint16_t, 3>{0, 0x7ff, 0x7ff});
  CHECK(calibration.convert({1.7e308, 0, 0}, converter) == 0);
  CHECK(converter == OmniBridge::safe().converter);
}

TEST_CASE("the gimbal's angles are those of its potentiometers, by (5.2)") {
  const Vector3d angles = calibration.gimbal({100, 300, 200}, {300, 100, 200});
  CHECK((angles - Vector3d(5.48 / 4 - 2.74, -5.28 * 3 / 4 + 2.64, -(4.76 / 2 - 2.38))).norm() < 1e-14);
  CHECK(calibration.gimbal({0, 0, 0}, {0, 0, 0}).allFinite());
}

TEST_CASE("a calibration without a torque scale, or with numbers that cannot be, is refused by its field") {
  CHECK_THROWS_WITH_AS(OmniCalibration{}.check(), doctest::Contains("OmniCalibration: full_scale"),
                       std::invalid_argument);
  OmniCalibration wrong = calibration;
  wrong.full_scale[1] = 0;
  CHECK_THROWS_WITH_AS(wrong.check(), doctest::Contains("full_scale"), std::invalid_argument);
  wrong = calibration;
  wrong.counts_sign[2] = 0.5;
  CHECK_THROWS_WITH_AS(wrong.check(), doctest::Contains("counts_sign"), std::invalid_argument);
  wrong = calibration;
  wrong.home[0] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(wrong.check(), doctest::Contains("home"), std::invalid_argument);
  wrong = calibration;
  wrong.counts_per_turn = 0;
  CHECK_THROWS_WITH_AS(wrong.check(), doctest::Contains("counts_per_turn"), std::invalid_argument);
}

TEST_CASE("no conversion allocates") {
  limpid::test::check_no_allocation([&] {
    std::array<std::uint16_t, 3> converter{};
    (void)calibration.joints({1, 2, 3}, {0, 0, 0});
    (void)calibration.gimbal({1, 2, 3}, {3, 2, 1});
    (void)calibration.convert({0.1, 0.1, 0.1}, converter);
  });
}
