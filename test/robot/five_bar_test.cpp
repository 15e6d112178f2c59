// SPDX-License-Identifier: MIT
#include <limpid/robot/five_bar.hpp>

#include "conformance/robot_suite.hpp"

#include <Eigen/LU>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

using Eigen::Vector2d, Eigen::Vector3d;
using limpid::FiveBar, limpid::test::check_robot;

static_assert(limpid::Robot<FiveBar<float>> && limpid::Robot<FiveBar<>> && limpid::Robot<FiveBar<long double>>);
static_assert(!limpid::Robot<limpid::FiveBarPose<>>);

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Neither side like the other, upright.
FiveBar<> uneven() { return FiveBar<>({.base = 0.06, .proximal = 0.18, .distal = 0.23, .gravity = {0.5, -9.8}}); }
Eigen::Matrix<double, 9, 1> uneven_theta() {
  Eigen::Matrix<double, 9, 1> theta;
  theta << 4e-4, 3e-4, -2e-5, 1e-5, 6e-3, 8e-4, 9e-4, 1e-3, 2e-3;
  return theta;
}

}  // namespace

TEST_CASE("FiveBar is a Robot flat, and upright with links of two lengths and sides that differ") {
  check_robot(FiveBar<>(), FiveBar<>().theta_of({}), 51);
  check_robot(uneven(), uneven_theta(), 52);
}

TEST_CASE("its energies are those of four rods and a weight, which move as differences of their places tell") {
  // a rod's mass, kg, centre from the joint at its base end, m, and inertia about its centre, kg m^2
  struct Rod {
    double mass, centre, inertia;
  };
  const Rod proximal[2] = {{0.005, 0.08, 2e-5}, {0.003, 0.1, 1e-5}},
            distal[2] = {{0.006, 0.09, 3e-5}, {0.002, 0.15, 8e-6}};
  const double tip = 0.004, rotor = 1.5e-4, l1 = 0.18, l2 = 0.23;
  Eigen::Matrix<double, 9, 1> theta = Eigen::Matrix<double, 9, 1>::Zero();
  theta[4] = tip;
  for (int i = 0; i < 2; ++i) {
    const auto [mp, cp, Ip] = proximal[i];
    const auto [md, cd, Id] = distal[i];
    const double at_elbow = md * (1 - cd / l2);
    theta[i] = rotor + Ip + mp * cp * cp + at_elbow * l1 * l1;
    theta[2 + i] = Id + md * cd * cd - md * cd * l2;
    theta[4] += md * cd / l2;
    theta[5 + i] = mp * cp + at_elbow * l1;
  }

  const FiveBar<> robot = uneven();
  // Places of the centres of mass and directions of the rods: four of each, and the tip.
  const auto places = [&](const Vector2d& q) {
    Eigen::Matrix<double, 2, 9> all;
    const Vector2d x = robot.at(q).position().head<2>();
    for (int i = 0; i < 2; ++i) {
      const Vector2d base(i == 0 ? -0.03 : 0.03, 0), along(std::cos(q[i]), std::sin(q[i])), elbow = base + l1 * along;
      const Vector2d further = (x - elbow) / l2;
      all.col(i) = base + proximal[i].centre * along;
      all.col(2 + i) = elbow + distal[i].centre * further;
      all.col(4 + i) = along;
      all.col(6 + i) = further;
    }
    all.col(8) = x;
    return all;
  };
  const auto potential = [&](const Vector2d& q) {
    const auto all = places(q);
    Vector2d moment = tip * all.col(8);
    for (int i = 0; i < 2; ++i) moment += proximal[i].mass * all.col(i) + distal[i].mass * all.col(2 + i);
    return -moment.dot(robot.gravity());
  };

  std::mt19937 random(55);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto limits = robot.limits();
  const double h = 1e-4;  // differences of fourth order: h^4 of the values, and their rounding over h: 1e-12
  for (int trial = 0; trial < 100; ++trial) {
    const Vector2d half = (limits.upper - limits.lower) / 2, qdot(uniform(random), uniform(random));
    const Vector2d q = limits.lower + half + half.cwiseProduct(Vector2d(uniform(random), uniform(random)));
    const auto slope = [&](auto&& f) {
      using Value = decltype(f(q));
      const Value near = f(q + h * qdot) - f(q - h * qdot), far = f(q + 2 * h * qdot) - f(q - 2 * h * qdot);
      return Value((8 * near - far) / (12 * h));
    };
    const Eigen::Matrix<double, 2, 9> rates = slope(places);
    double twice_kinetic = tip * rates.col(8).squaredNorm() + rotor * qdot.squaredNorm();
    for (int i = 0; i < 2; ++i) {
      twice_kinetic +=
          proximal[i].mass * rates.col(i).squaredNorm() + proximal[i].inertia * rates.col(4 + i).squaredNorm();
      twice_kinetic +=
          distal[i].mass * rates.col(2 + i).squaredNorm() + distal[i].inertia * rates.col(6 + i).squaredNorm();
    }
    const auto pose = robot.at(q);
    CHECK(std::abs(qdot.dot(pose.H(theta) * qdot) - twice_kinetic) < 1e-14);  // 0.02 kg at 0.3 m/s, in J
    CHECK(std::abs(pose.tau_g(theta).dot(qdot) - slope(potential)) < 1e-11);
  }
}

TEST_CASE("its links keep their lengths, and the tip is where they meet, ahead of the elbows") {
  const FiveBar<> robot = uneven();
  const auto limits = robot.limits();
  std::mt19937 random(53);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const Vector2d share(uniform(random), uniform(random));
    const Vector2d q = limits.lower + share.cwiseProduct(limits.upper - limits.lower);
    const Vector3d x = robot.at(q).position();
    const Vector2d elbow1(-0.03 + 0.18 * std::cos(q[0]), 0.18 * std::sin(q[0]));
    const Vector2d elbow2(0.03 + 0.18 * std::cos(q[1]), 0.18 * std::sin(q[1]));
    const Vector2d to1 = x.head<2>() - elbow1, to2 = x.head<2>() - elbow2, between = elbow2 - elbow1;
    CHECK(std::abs(to1.norm() - 0.23) < 2e-15);  // some roundings of 0.5 m
    CHECK(std::abs(to2.norm() - 0.23) < 2e-15);
    CHECK(x[2] == 0);
    CHECK(between[0] * to1[1] - between[1] * to1[0] > 0);
  }
}

TEST_CASE("at a symmetric pose the tip is on the axis between the motors") {
  // q = (pi - a, a), cos a = 3/5: elbows 0.05 + 0.12 off the axis, 0.16 up; the tip sqrt(0.2^2 - 0.17^2) above them.
  const double a = std::acos(0.6);
  const Vector3d x = FiveBar<>().at({std::acos(-0.6), a}).position();
  CHECK((x - Vector3d(0, 0.16 + std::sqrt(0.0111), 0)).cwiseAbs().maxCoeff() < 1e-15);
}

TEST_CASE("theta of rods: half a distal rod's mass at each of its ends, and what that has too much of inertia") {
  const auto theta =
      FiveBar<>().theta_of({.proximal = 0.006, .distal = 0.012, .tip = 0.005, .rotor = 1e-4, .friction = 0.003});
  Eigen::Matrix<double, 9, 1> expected;
  // I = rotor + m_p l1^2/3 + (m_d/2) l1^2, E = m_d l2^2/3 - m_d l2^2/2, s = (m_p/2 + m_d/2) l1
  expected << 4.2e-4, 4.2e-4, -8e-5, -8e-5, 0.017, 1.8e-3, 1.8e-3, 0.003, 0.003;
  CHECK((theta - expected).cwiseAbs().maxCoeff() < 1e-17);
  CHECK_THROWS_WITH_AS((void)FiveBar<>().theta_of({.tip = -1}),
                       "FiveBar: Masses: tip: expected finite and >= 0, got -1", std::invalid_argument);
  CHECK_THROWS_AS((void)FiveBar<>().theta_of({.rotor = infinity}), std::invalid_argument);
}

TEST_CASE("every entry of theta shows in the torques where there is gravity in the plane, and only there") {
  const auto rank = [](const FiveBar<>& robot) {
    std::mt19937 random(54);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto any = [&](double size) -> Vector2d { return Vector2d(uniform(random), uniform(random)) * size; };
    const auto limits = robot.limits();
    Eigen::Matrix<double, 9, 9> gram = Eigen::Matrix<double, 9, 9>::Zero();
    for (int i = 0; i < 200; ++i) {
      const Vector2d half = (limits.upper - limits.lower) / 2, q = limits.lower + half + half.cwiseProduct(any(1));
      const auto phi = robot.at(q).regressor(any(5), any(30));
      gram += phi.transpose() * phi;
    }
    const Eigen::Matrix<double, 9, 1> size = gram.diagonal().cwiseSqrt().cwiseMax(1e-300);  // of the columns
    gram = size.cwiseInverse().asDiagonal() * gram * size.cwiseInverse().asDiagonal();
    Eigen::FullPivLU<Eigen::Matrix<double, 9, 9>> lu(gram);
    return lu.setThreshold(1e-6).rank();  // squares of what is told from rounding
  };
  CHECK(rank(uneven()) == 9);
  CHECK(rank(FiveBar<>()) == 7);  // s1 and s2 are gravity's alone
}

TEST_CASE("every pose within the limits is closed and clear of singularities, up to the corners") {
  const FiveBar<> robot;
  const auto limits = robot.limits();
  for (int i = 0; i <= 200; ++i) {
    for (int j = 0; j <= 200; ++j) {
      const Vector2d share(i / 200.0, j / 200.0);
      const Vector3d sines = robot.at(limits.lower + share.cwiseProduct(limits.upper - limits.lower)).sines();
      if (!(sines[0] > 0.125 && sines[1] < -0.125 && sines[2] > 0.125)) FAIL(i, " ", j, ": ", sines.transpose());
    }
  }
}

TEST_CASE("the sines of the angles between its links are those of J, Phi and their singularities") {
  const Vector2d q(1.75, 0.75);
  const auto pose = FiveBar<>().at(q);
  const Vector3d sines = pose.sines(), x = pose.position();
  const Eigen::Matrix2d J = pose.jacobian().topRows<2>();
  CHECK(J.determinant() == doctest::Approx(0.04 * sines[1] * sines[2] / sines[0]).epsilon(1e-14));
  const Vector2d link1 = x.head<2>() - Vector2d(-0.05 + 0.2 * std::cos(q[0]), 0.2 * std::sin(q[0]));
  CHECK(sines[1] == doctest::Approx(std::sin(std::atan2(link1[1], link1[0]) - q[0])).epsilon(1e-14));
}

TEST_CASE("where the loop is open every answer is non-finite") {
  const auto pose = FiveBar<>().at({3.0, 0.1});  // elbows 0.497 m apart
  const auto theta = FiveBar<>().theta_of({});
  const Vector2d rate(0.1, 0.2);
  CHECK_FALSE(limpid::is_finite(pose.position()));
  CHECK_FALSE(limpid::is_finite(pose.jacobian()));
  CHECK_FALSE(limpid::is_finite(pose.H(theta)));
  CHECK_FALSE(limpid::is_finite(pose.torque(theta, rate, rate, rate)));
}

TEST_CASE("settings that cannot be are refused with their value") {
  using Settings = FiveBar<>::Settings;
  CHECK_THROWS_WITH_AS(FiveBar<>(Settings{.base = -0.1}), "FiveBar: base: expected finite and >= 0, got -0.1",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(FiveBar<>(Settings{.proximal = 0}), "FiveBar: proximal: expected finite and > 0, got 0",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(FiveBar<>(Settings{.distal = infinity}), "FiveBar: distal: expected finite and > 0, got inf",
                       std::invalid_argument);
  CHECK_THROWS_AS(FiveBar<>(Settings{.gravity = {infinity, 0}}), std::invalid_argument);
  CHECK_THROWS_AS(FiveBar<>(Settings{.torque = {1, 0}}), std::invalid_argument);
  CHECK_THROWS_AS(FiveBar<>(Settings{.static_friction = {-1, 0}}), std::invalid_argument);
  CHECK_THROWS_AS(FiveBar<>(Settings{.lower = {2.1, 0.3}}), std::invalid_argument);
  CHECK_THROWS_AS(FiveBar<>(Settings{.lower = {1.5, std::nan("")}}), std::invalid_argument);
}

TEST_CASE("limits within which the loop opens, or a side stretches, are refused with such joints") {
  using Settings = FiveBar<>::Settings;
  // elbows 0.1 + 0.2 (cos 0.33 + cos 0.4) = 0.473 m apart, the links reach 0.4 m
  CHECK_THROWS_AS(FiveBar<>(Settings{.upper = {3.14159265358979323846 - 0.33, 1.25}}), std::invalid_argument);
  CHECK_THROWS_AS(FiveBar<>(Settings{.distal = 0.17}), std::invalid_argument);
  CHECK_THROWS_AS(FiveBar<>(Settings{.lower = {1.3, 0.4}}), std::invalid_argument);
  CHECK_THROWS_AS(FiveBar<>(Settings{.lower = {1.5, -0.01}}), std::invalid_argument);
  CHECK_NOTHROW(FiveBar<>(Settings{.lower = {1.65, 0.8}, .upper = {2.3, 1.5}}));  // about the axis of symmetry
}
