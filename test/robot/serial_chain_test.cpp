// SPDX-License-Identifier: MIT
#include <limpid/robot/serial_chain.hpp>

#include "chains.hpp"
#include "conformance/robot_suite.hpp"
#include "support/no_allocation.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>

using Eigen::Matrix3d, Eigen::Vector3d;
using limpid::BodyInertia, limpid::BodyParameters, limpid::is_physical, limpid::JointKind, limpid::rigid_body,
    limpid::Robot, limpid::SerialChain, limpid::slender_rod;
using limpid::test::check_robot, limpid::test::RandomChains;

static_assert(Robot<SerialChain<1>> && Robot<SerialChain<6>> && Robot<SerialChain<7, float>>);
static_assert(!std::is_default_constructible_v<SerialChain<3>>, "no arm is without links");

TEST_CASE("chains of three joints keep the laws of Robot, with links of random mass, turning and sliding") {
  RandomChains random(11);
  const auto theta = random.theta<3>();
  for (unsigned i = 0; i < 5; ++i) check_robot(random.chain<3>(), theta, i, 5);
  check_robot(random.chain<3>(1), theta, 5);
  for (unsigned i = 6; i < 10; ++i) check_robot(random.chain<3>(0.5), theta, i, 5);
}

TEST_CASE("C is that of Christoffel's symbols of H") {
  RandomChains random(12);
  const auto chain = random.chain<3>(0.3);
  const auto theta = random.theta<3>();
  for (int trial = 0; trial < 20; ++trial) {
    CAPTURE(trial);
    const Vector3d q = random.joints<3>(-2, 2), qdot = random.joints<3>(-1, 1);
    Matrix3d slope[3];  // of H along each joint, by differences of fourth order
    const double step = 1e-3;
    for (int k = 0; k < 3; ++k) {
      const auto H = [&](double s) { return chain.at(q + s * step * Vector3d::Unit(k)).H(theta); };
      slope[k] = (8 * (H(1) - H(-1)) - (H(2) - H(-2))) / (12 * step);
    }
    Matrix3d expected = Matrix3d::Zero();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        for (int k = 0; k < 3; ++k) expected(i, j) += (slope[k](i, j) + slope[j](i, k) - slope[i](j, k)) / 2 * qdot[k];
      }
    }
    // Differences leave eps / step of H, some 4 kg m^2.
    CHECK((chain.at(q).C(theta, qdot) - expected).cwiseAbs().maxCoeff() < 1e-10);
  }
}

TEST_CASE("the tip's frame turns with the angular velocity that angular_jacobian says") {
  RandomChains random(13);
  const auto chain = random.chain<3>(0.3);
  const Vector3d q = random.joints<3>(-2, 2), qdot = random.joints<3>(-1, 1);
  const double step = 1e-3;
  const auto R = [&](double s) { return chain.at(q + s * step * qdot).rotation(); };
  const Matrix3d Rdot = (8 * (R(1) - R(-1)) - (R(2) - R(-2))) / (12 * step);
  const Vector3d omega = chain.at(q).angular_jacobian() * qdot;
  for (int i = 0; i < 3; ++i) CHECK((Rdot.col(i) - omega.cross(R(0).col(i))).norm() < 1e-11);
  CHECK((R(0) * R(0).transpose() - Matrix3d::Identity()).norm() < 1e-15);
  CHECK(std::abs(R(0).determinant() - 1) < 1e-15);
}

TEST_CASE("a pendulum of one rod has its textbook inertia and gravity torque") {
  const double quarter = std::acos(0.0), m = 0.5, l = 0.4;
  const SerialChain<1> pendulum({.links = {{{.alpha = quarter}}}, .tip = Vector3d(l, 0, 0)});
  const auto theta =
      SerialChain<1>::theta({slender_rod<double>(m, {0, 0, 0}, {l, 0, 0})}, SerialChain<1>::Joints(0.01));
  const auto pose = pendulum.at(SerialChain<1>::Joints(0.3));
  CHECK(pose.position().isApprox(Vector3d(l * std::cos(0.3), 0, l * std::sin(0.3)), 1e-15));
  CHECK(pose.H(theta)(0, 0) == doctest::Approx(m * l * l / 3).epsilon(1e-15));
  CHECK(pose.tau_g(theta)[0] == doctest::Approx(m * 9.81 * l / 2 * std::cos(0.3)).epsilon(1e-15));
  CHECK(pose.B(theta)(0, 0) == 0.01);
}

TEST_CASE("a mass on a slide that turns feels Coriolis' force") {
  const double m = 2, rho = 0.7, omega = 3, v = 0.5;
  // Joint 1 turns about the vertical, joint 2 slides along a horizontal line through it.
  const SerialChain<2> slide({.links = {{{.alpha = 0}, {.alpha = std::acos(0.0), .joint = JointKind::prismatic}}}});
  BodyParameters<double> point = BodyParameters<double>::Zero();
  point[0] = m;
  const auto theta = SerialChain<2>::theta({BodyParameters<double>::Zero(), point});
  const Eigen::Vector2d qdot(omega, v);
  const auto pose = slide.at({0.4, rho});
  CHECK(pose.position().norm() == doctest::Approx(rho));
  const Eigen::Vector2d torque = pose.torque(theta, qdot, qdot, Eigen::Vector2d::Zero());
  CHECK(torque[0] == doctest::Approx(2 * m * rho * omega * v).epsilon(1e-14));
  CHECK(torque[1] == doctest::Approx(-m * rho * omega * omega).epsilon(1e-14));
}

TEST_CASE("a body seen from another frame and back is itself, and a rod is the sum of its halves") {
  RandomChains random(14);
  const auto body = random.body();
  const Matrix3d R = random.chain<3>().at(random.joints<3>(-2, 2)).rotation();
  const Vector3d p = random.point();
  const auto there = BodyInertia<double>::of(body).seen_from(R, p);
  CHECK(there.seen_from(R.transpose(), -(R.transpose() * p)).parameters().isApprox(body, 1e-14));
  const Vector3d from = random.point(), to = random.point(), middle = (from + to) / 2;
  CHECK(slender_rod(2.0, from, to).isApprox(slender_rod(1.0, from, middle) + slender_rod(1.0, middle, to), 1e-14));
}

TEST_CASE("parameters are a body's where a distribution of mass has them") {
  RandomChains random(15);
  CHECK(is_physical(random.body()));
  const auto rod = slender_rod<double>(1, {0, 0, 0}, {1, 0, 0});
  CHECK_FALSE(is_physical(rod));  // no volume
  CHECK(is_physical(rod, 1e-12));
  const Matrix3d triangle = Vector3d(1, 1, 3).asDiagonal();  // I_zz above I_xx + I_yy
  CHECK_FALSE(is_physical(rigid_body(1.0, Vector3d(0, 0, 0), triangle), 1e-12));
  CHECK_FALSE(is_physical(BodyParameters<double>(-random.body())));
}

TEST_CASE("settings that cannot be are refused with their value") {
  using Settings = SerialChain<2>::Settings;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Settings settings{.links = {}};
  settings.links[1].d = nan;
  CHECK_THROWS_WITH_AS(SerialChain<2>{settings}, "SerialChain: links[1]: expected finite, got 0 0 nan 0",
                       std::invalid_argument);
  settings = Settings{.links = {}, .tip = Vector3d(0, nan, 0)};
  CHECK_THROWS_WITH_AS(SerialChain<2>{settings}, "SerialChain: tip: expected finite, got 0 nan 0",
                       std::invalid_argument);
  settings = Settings{.links = {}, .gravity = Vector3d(0, 0, nan)};
  CHECK_THROWS_WITH_AS(SerialChain<2>{settings}, "SerialChain: gravity: expected finite, got 0 0 nan",
                       std::invalid_argument);
  settings = Settings{.links = {}};
  settings.limits.lower = Eigen::Vector2d(0, 4);
  CHECK_THROWS_AS(SerialChain<2>{settings}, std::invalid_argument);
  settings = Settings{.links = {}};
  settings.limits.torque[0] = 0;
  CHECK_THROWS_AS(SerialChain<2>{settings}, std::invalid_argument);
  settings = Settings{.links = {}};
  settings.limits.static_friction[0] = -1;
  CHECK_THROWS_AS(SerialChain<2>{settings}, std::invalid_argument);
}

TEST_CASE("a pose, its rotation and its angular Jacobian ask for no memory") {
  RandomChains random(16);
  const auto chain = random.chain<3>();
  const Vector3d q = random.point();
  double sum = 0;
  limpid::test::check_no_allocation([&] {
    const auto pose = chain.at(q);
    sum = pose.rotation().sum() + pose.angular_jacobian().sum();
  });
  CHECK(std::isfinite(sum));
}
