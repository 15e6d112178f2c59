// SPDX-License-Identifier: MIT
#include <limpid/robot/body_inertia.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/robot/serial_chain.hpp>

#include "omni_states.hpp"
#include "worst.hpp"

#include <doctest/doctest.h>

#include <cmath>

using Eigen::Matrix3d, Eigen::Vector3d;
using limpid::Omni, limpid::rigid_body, limpid::SerialChain, limpid::slender_rod;
using limpid::test::OmniState, limpid::test::OmniStates, limpid::test::Worst;

namespace {

constexpr double l2 = 0.135, l3 = 0.130;  // Table 5.2, m
constexpr double m2 = 0.21, m3 = 0.17;    // kg
constexpr double base_inertia = 3.7e-3;   // I_1 about the vertical axis, kg m^2
const Vector3d friction(0.096, 0.145, 0.055);

/// The Omni of section 3.3: q1 about the vertical, q2 and q3 about axes that point to its right.
SerialChain<3> chain() {
  const double quarter = std::acos(0.0);
  return SerialChain<3>({.links = {{{.alpha = 0}, {.alpha = quarter}, {.a = l2}}},
                         .tip = Vector3d(l3, 0, 0),
                         .limits = Omni<>().limits()});
}

/// Links 2 and 3 are uniform rods, link 1 turns with the inertia I_1 about its axis.
Eigen::Matrix<double, 33, 1> chain_theta() {
  const Vector3d o = Vector3d::Zero(), end2(l2, 0, 0), end3(l3, 0, 0);
  const Matrix3d I1 = Vector3d(base_inertia / 2, base_inertia / 2, base_inertia).asDiagonal();
  return SerialChain<3>::theta({rigid_body(1.0, o, I1), slender_rod(m2, o, end2), slender_rod(m3, o, end3)}, friction);
}

/// (3.25) with the centres in the middles and I_2, I_3 = m l^2 / 12.
Omni<>::Parameters omni_theta() {
  Omni<>::Parameters theta;
  theta << base_inertia, m2 * l2 * l2 / 3 + m3 * l2 * l2, m3 * l3 * l3 / 3, m3 * l2 * l3 / 2, m2 * l2 / 2 + m3 * l2,
      m3 * l3 / 2, friction;
  return theta;
}

/// Errors over the size of what is compared, at random motions.
Worst compare(unsigned seed, auto&& from_chain, auto&& from_omni) {
  const auto theta = chain_theta();
  const auto omni = omni_theta();
  OmniStates random(seed);
  Worst worst;
  for (int i = 0; i < 10'000; ++i) {
    const OmniState is = random(), reference = random();
    const auto expected = from_omni(Omni<>().at(is.q), omni, is, reference).eval();
    const auto actual = from_chain(chain().at(is.q), theta, is, reference).eval();
    const double size = 1 + expected.cwiseAbs().maxCoeff();
    worst.see((actual - expected) / size, i);
  }
  return worst;
}

Worst compare(unsigned seed, auto&& of_either) { return compare(seed, of_either, of_either); }

}  // namespace

TEST_CASE("a chain built as an Omni from the masses of its rods has the Omni's kinematics to 1e-12") {
  CHECK(compare(1, [](const auto& pose, auto&...) { return pose.position(); }).error() < 1e-12);
  CHECK(compare(2, [](const auto& pose, auto&...) { return pose.jacobian(); }).error() < 1e-12);
  CHECK(compare(3, [](const auto& pose, auto&, const auto& is, auto&) { return pose.jacobian_dot(is.qdot); }).error() <
        1e-12);
}

TEST_CASE("and its dynamics, with the same C, because (3.22) is that of Christoffel's symbols too") {
  CHECK(compare(4, [](const auto& pose, const auto& theta, auto&...) { return pose.H(theta); }).error() < 1e-12);
  CHECK(compare(5, [](const auto& pose, const auto& theta, const auto& is, auto&) {
          return pose.C(theta, is.qdot);
        }).error() < 1e-12);
  CHECK(compare(6, [](const auto& pose, const auto& theta, const auto& is, auto&) {
          return (pose.C(theta, is.qdot) * is.qdot).eval();
        }).error() < 1e-12);
  CHECK(compare(7, [](const auto& pose, const auto& theta, auto&...) { return pose.B(theta); }).error() < 1e-12);
  CHECK(compare(8, [](const auto& pose, const auto& theta, auto&...) { return pose.tau_g(theta); }).error() < 1e-12);
}

TEST_CASE("and its torques, by recursion and by either regressor") {
  CHECK(compare(9, [](const auto& pose, const auto& theta, const auto& is, const auto& r) {
          return pose.torque(theta, is.qdot, r.qdot, r.qddot);
        }).error() < 1e-12);
  CHECK(compare(10, [](const auto& pose, const auto& theta, const auto& is, const auto& r) {
          return (pose.regressor(is.qdot, r.qdot, r.qddot) * theta).eval();
        }).error() < 1e-12);
  CHECK(compare(11, [](const auto& pose, const auto& theta, const auto& is, const auto&) {
          return (pose.regressor(is.qdot, is.qddot) * theta).eval();
        }).error() < 1e-12);
}

TEST_CASE("along the line of rods of any mass the two adapt alike: theta of (3.25) is a linear map of the chain's") {
  // d theta_omni / d(m2, m3): the chain of (3.25), by hand; phi_r' delta must agree after it.
  Eigen::Matrix<double, 9, 2> omni_slope = Eigen::Matrix<double, 9, 2>::Zero();
  omni_slope.col(0) << 0, l2 * l2 / 3, 0, 0, l2 / 2, 0, 0, 0, 0;
  omni_slope.col(1) << 0, l2 * l2, l3 * l3 / 3, l2 * l3 / 2, l2, l3 / 2, 0, 0, 0;
  Eigen::Matrix<double, 33, 2> chain_slope = Eigen::Matrix<double, 33, 2>::Zero();
  const Vector3d o = Vector3d::Zero();
  chain_slope.col(0).segment<10>(10) = slender_rod(1.0, o, Vector3d(l2, 0, 0));
  chain_slope.col(1).segment<10>(20) = slender_rod(1.0, o, Vector3d(l3, 0, 0));
  const auto direction = [](const auto& slope) {
    return [&slope](const auto& pose, auto&, const auto& is, const auto& r) {
      return (slope.transpose() * pose.adaptation_direction(is.qdot, r.qdot, r.qddot, Vector3d(is.qdot - r.qdot)))
          .eval();
    };
  };
  CHECK(compare(12, direction(chain_slope), direction(omni_slope)).error() < 1e-12);
}
