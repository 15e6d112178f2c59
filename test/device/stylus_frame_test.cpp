// SPDX-License-Identifier: MIT
#include <limpid/device/stylus_frame.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_device.hpp>

#include <support/no_allocation.hpp>

#include <Eigen/Geometry>

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

using limpid::DeviceState;
using limpid::ForceReading;
using limpid::Omni;
using limpid::OmniDevice;
using limpid::Status;
using limpid::StylusFrame;
using namespace std::chrono_literals;

namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

const double quarter = std::acos(-1.0) / 2;
constexpr double roundings = 1e-15;  // of a product of five rotations

Matrix about(int axis, double angle) { return Eigen::AngleAxisd(angle, Vector::Unit(axis)).toRotationMatrix(); }

struct Pose {
  Vector q, gimbal;
};

Pose any_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> angle(-3, 3);
  Pose pose;
  for (int i = 0; i < 3; ++i) pose.q[i] = angle(random);
  for (int i = 0; i < 3; ++i) pose.gimbal[i] = angle(random);
  return pose;
}

}  // namespace

TEST_CASE("with all angles zero the sensor's frame is the base frame") {
  CHECK(StylusFrame<>().rotation(Vector::Zero(), Vector::Zero()) == Matrix::Identity());
}

TEST_CASE("a pose worked out by hand") {
  // The arm turned to the left, its last link hanging down: link x is -z, link y is -x, link z is y of the base.
  // Yaw and roll of a quarter turn: stylus x is link y, stylus y is link z, stylus z is link x.
  // So stylus x is -x, stylus y is y, stylus z is -z.
  const Matrix R = StylusFrame<>().rotation({quarter, 0, -quarter}, {quarter, 0, quarter});
  CHECK((R * Vector(1, 2, 3) - Vector(-1, 2, -3)).norm() < 4 * roundings);
  // And pitch alone, arm ahead: stylus x points down, stylus z ahead.
  const Matrix P = StylusFrame<>().rotation(Vector::Zero(), {0, quarter, 0});
  CHECK((P * Vector(1, 2, 3) - Vector(3, 2, -1)).norm() < 4 * roundings);
}

TEST_CASE("any pose is a rotation, composed as it says") {
  std::mt19937 random(4);
  const Matrix mount = about(0, 0.3) * about(2, -1.1);
  const StylusFrame<> frame, mounted({.mount = mount});
  for (int k = 0; k < 200; ++k) {
    const auto [q, gimbal] = any_pose(random);
    const Matrix R = frame.rotation(q, gimbal);
    CHECK((R.transpose() * R - Matrix::Identity()).cwiseAbs().maxCoeff() < roundings);
    CHECK(R.determinant() == doctest::Approx(1).epsilon(roundings));
    const Matrix composed =
        about(2, q[0]) * about(1, -(q[1] + q[2])) * about(2, gimbal[0]) * about(1, gimbal[1]) * about(0, gimbal[2]);
    CHECK((R - composed).cwiseAbs().maxCoeff() < 2 * roundings);
    CHECK((mounted.rotation(q, gimbal) - R * mount).cwiseAbs().maxCoeff() < 2 * roundings);
    const Matrix turned = frame.rotation(q + Vector(0.7, 0, 0), gimbal);
    CHECK((turned - about(2, 0.7) * R).cwiseAbs().maxCoeff() < 2 * roundings);
  }
}

TEST_CASE("the link's frame is frame 3 of the thesis, x along the link, z up") {
  std::mt19937 random(5);
  for (int k = 0; k < 100; ++k) {
    const Vector q = any_pose(random).q;
    const double c1 = std::cos(q[0]), s1 = std::sin(q[0]), c23 = std::cos(q[1] + q[2]), s23 = std::sin(q[1] + q[2]);
    Matrix frame_3;  // of 0_3T, section 3.3
    frame_3 << c1 * c23, -c1 * s23, s1, s1 * c23, -s1 * s23, -c1, s23, c23, 0;
    const Matrix R = StylusFrame<>().rotation(q, Vector::Zero());
    CHECK((R.col(0) - frame_3.col(0)).norm() < roundings);
    CHECK((R.col(1) + frame_3.col(2)).norm() < roundings);
    CHECK((R.col(2) - frame_3.col(1)).norm() < roundings);
    // x is where the tip goes when the link grows
    const Vector grown = Omni<>({.link3 = 0.230}).at(q).position() - Omni<>({.link3 = 0.130}).at(q).position();
    CHECK((R.col(0) - grown / 0.1).norm() < 1e-14);  // of lengths of 0.3 m over 0.1 m
  }
}

TEST_CASE("a reading is turned by the device's joints and gimbal, and keeps its stamp") {
  DeviceState<3> state;
  state.q << quarter, 0, -quarter;
  state.gimbal = OmniDevice<>::yaw_pitch_roll({quarter, 0, -quarter});  // the Omni's own roll is opposite, (5.2)
  state.stamp = 9ms;
  const ForceReading<> felt{{1, 2, 3}, 7ms, Status::overload};
  const ForceReading<> turned = StylusFrame<>().in_base(felt, state);
  CHECK((turned.force - Vector(-1, 2, -3)).norm() < 4 * roundings);
  CHECK(turned.stamp == 7ms);
  CHECK(turned.status == Status::overload);
  state.status = Status::stale;
  CHECK(StylusFrame<>().in_base(felt, state).status == (Status::overload | Status::stale));
}

TEST_CASE("angles that are not finite give no force and say so") {
  DeviceState<3> state;
  state.gimbal[1] = std::numeric_limits<double>::quiet_NaN();
  const ForceReading<> turned = StylusFrame<>().in_base({{1, 2, 3}, 7ms, Status::ok}, state);
  CHECK(turned.force == Vector::Zero());
  CHECK(turned.status == Status::not_finite);
}

TEST_CASE("a mount that is no rotation is refused") {
  Matrix mount = Matrix::Identity();
  mount(2, 2) = -1;  // a mirror
  CHECK_THROWS_AS(StylusFrame<>({.mount = mount}), std::invalid_argument);
  CHECK_THROWS_AS(StylusFrame<>({.mount = Matrix::Identity() * 1.01}), std::invalid_argument);
  CHECK_THROWS_AS(StylusFrame<>({.mount = Matrix::Constant(std::nan(""))}), std::invalid_argument);
  CHECK_NOTHROW(StylusFrame<>({.mount = about(1, 0.5)}));
}

TEST_CASE_TEMPLATE("other scalars turn, too, without allocation", Scalar, float, long double) {
  const StylusFrame<Scalar> frame;
  ForceReading<Scalar> turned;
  DeviceState<3, Scalar> state;
  state.q << Scalar(0.3), Scalar(0.2), Scalar(-0.9);
  limpid::test::check_no_allocation([&] { turned = frame.in_base({{1, 2, 2}, 7ms, Status::ok}, state); });
  CHECK(std::abs(turned.force.norm() - 3) < 16 * std::numeric_limits<Scalar>::epsilon());
}
