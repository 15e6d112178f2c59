// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/robot/robot.hpp>

#include <Eigen/Core>

#include <cmath>

namespace limpid::test {

/// A pendulum of 1 m in the x-z plane, q from the vertical below: the smallest Robot, with dynamics by hand.
///
///     theta = (I, m g, b)        I q'' + b q' + m g sin q = tau + J' F
template <Real Scalar_ = double>
struct Pendulum {
  using Scalar = Scalar_;
  static constexpr int joints = 1;
  static constexpr int parameters = 3;
  using Vector = Eigen::Matrix<Scalar, 1, 1>;
  using Parameters = Eigen::Matrix<Scalar, 3, 1>;

  struct Pose {
    Scalar c, s;

    Eigen::Matrix<Scalar, 3, 1> position() const noexcept { return {s, Scalar(0), -c}; }
    Eigen::Matrix<Scalar, 3, 1> jacobian() const noexcept { return {c, Scalar(0), s}; }
    Eigen::Matrix<Scalar, 3, 1> jacobian_dot(const Vector& qdot) const noexcept {
      return {-s * qdot[0], Scalar(0), c * qdot[0]};
    }
    Vector H(const Parameters& theta) const noexcept { return Vector(theta[0]); }
    Vector C(const Parameters&, const Vector&) const noexcept { return Vector(Scalar(0)); }
    Vector B(const Parameters& theta) const noexcept { return Vector(theta[2]); }
    Vector tau_g(const Parameters& theta) const noexcept { return Vector(theta[1] * s); }
    Eigen::Matrix<Scalar, 1, 3> regressor(const Vector& qdot, const Vector& qddot) const noexcept {
      return {qddot[0], s, qdot[0]};
    }
    Eigen::Matrix<Scalar, 1, 3> regressor(const Vector&, const Vector& qdot_r, const Vector& qddot_r) const noexcept {
      return {qddot_r[0], s, qdot_r[0]};
    }
    Vector torque(const Parameters& theta, const Vector&, const Vector& qdot_r, const Vector& qddot_r) const noexcept {
      return Vector(qddot_r[0] * theta[0] + s * theta[1] + qdot_r[0] * theta[2]);
    }
    Parameters adaptation_direction(const Vector&, const Vector& qdot_r, const Vector& qddot_r,
                                    const Vector& delta) const noexcept {
      return {qddot_r[0] * delta[0], s * delta[0], qdot_r[0] * delta[0]};
    }
  };

  Pose at(const Vector& q) const noexcept {
    using std::cos, std::sin;
    return {cos(q[0]), sin(q[0])};
  }
  JointLimits<1, Scalar> limits() const noexcept {
    return {.lower = Vector(Scalar(-1)),
            .upper = Vector(Scalar(1)),
            .torque = Vector(Scalar(2)),
            .static_friction = Vector(Scalar(0))};
  }
};

static_assert(Robot<Pendulum<>>);

}  // namespace limpid::test
