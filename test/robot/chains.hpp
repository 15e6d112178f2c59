// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/robot/body_inertia.hpp>
#include <limpid/robot/denavit_hartenberg.hpp>
#include <limpid/robot/serial_chain.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <random>

namespace limpid::test {

/// The PUMA 560 with the table of Armstrong, Khatib and Burdick, "The explicit dynamic model
/// and inertial parameters of the PUMA 560 arm", ICRA 1986; its tip is the origin of frame 6, the centre of the wrist,
/// moved 0.1 m along the tool.
inline SerialChain<6>::Settings puma_560_settings() {
  const double quarter = std::acos(0.0);
  return {.links = {{{.alpha = 0},
                     {.alpha = -quarter, .d = 0.2435},
                     {.a = 0.4318, .d = -0.0934},
                     {.alpha = quarter, .a = -0.0203, .d = 0.4331},
                     {.alpha = -quarter},
                     {.alpha = quarter}}},
          .tip = Eigen::Vector3d(0, 0, 0.1)};
}

inline SerialChain<6> puma_560() { return SerialChain<6>(puma_560_settings()); }

/// Its links' masses, centres and principal inertias from the same paper, without the motors' rotors. Of link 1 only
/// I_zz acts; the other two are those of a plate.
inline SerialChain<6>::Parameters puma_560_theta() {
  const auto link = [](double mass, const Eigen::Vector3d& centre, const Eigen::Vector3d& inertia) {
    return rigid_body(mass, centre, Eigen::Matrix3d(inertia.asDiagonal()));
  };
  return SerialChain<6>::theta(
      {link(0, {0, 0, 0}, {0.175, 0.175, 0.35}), link(17.40, {0.068, 0.006, -0.016}, {0.130, 0.524, 0.539}),
       link(4.80, {0, -0.070, 0.014}, {0.066, 0.0125, 0.066}), link(0.82, {0, 0, -0.019}, {1.8e-3, 1.8e-3, 1.3e-3}),
       link(0.34, {0, 0, 0}, {0.3e-3, 0.3e-3, 0.4e-3}), link(0.09, {0, 0, 0.032}, {0.15e-3, 0.15e-3, 0.04e-3})});
}

/// Chains of links up to 0.5 m with every kind of twist, and bodies of some points of mass in them.
class RandomChains {
 public:
  explicit RandomChains(unsigned seed) : random_{seed} {}

  template <int N, Real Scalar = double>
  SerialChain<N, Scalar> chain(double prismatic_share = 0) {
    typename SerialChain<N, Scalar>::Settings settings{.links = {}, .tip = point<Scalar>()};
    for (auto& row : settings.links) {
      row = {.alpha = Scalar(uniform(-3, 3)),
             .a = Scalar(uniform(-0.5, 0.5)),
             .d = Scalar(uniform(-0.5, 0.5)),
             .theta = Scalar(uniform(-3, 3)),
             .joint = uniform(0, 1) < prismatic_share ? JointKind::prismatic : JointKind::revolute};
    }
    settings.gravity = 10 * point<Scalar>();
    return SerialChain<N, Scalar>(settings);
  }

  /// A theta that could be the links': each has five points of mass, which span a volume.
  template <int N, Real Scalar = double>
  auto theta() {
    typename SerialChain<N, Scalar>::template PerLink<BodyParameters<Scalar>> links;
    for (auto& link : links) link = body<Scalar>();
    return SerialChain<N, Scalar>::theta(links, joints<N, Scalar>(0, 0.2));
  }

  template <Real Scalar = double>
  BodyParameters<Scalar> body() {
    using Matrix = Eigen::Matrix<Scalar, 3, 3>;
    BodyParameters<Scalar> body = BodyParameters<Scalar>::Zero();
    for (int i = 0; i < 5; ++i) {
      body += rigid_body(Scalar(uniform(0.1, 1)), point<Scalar>(), Matrix(Matrix::Zero()));
    }
    return body;
  }

  template <int N, Real Scalar = double>
  Eigen::Matrix<Scalar, N, 1> joints(double low, double high) {
    Eigen::Matrix<Scalar, N, 1> q;
    for (int i = 0; i < N; ++i) q[i] = Scalar(uniform(low, high));
    return q;
  }

  template <Real Scalar = double>
  Eigen::Matrix<Scalar, 3, 1> point() {
    return joints<3, Scalar>(-0.5, 0.5);
  }

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  std::mt19937 random_;
};

}  // namespace limpid::test
