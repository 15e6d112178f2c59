// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/robot/body_inertia.hpp>

#include <Eigen/Core>

namespace limpid {

/// How a frame moves: its angular velocity, rad/s, and the velocity of its origin, m/s, in its own coordinates.
template <Real Scalar = double>
struct Twist {
  Eigen::Matrix<Scalar, 3, 1> omega, v;
};

/// What a body asks of what carries it: moment about the origin, N m, and force, N.
template <Real Scalar = double>
struct Wrench {
  Eigen::Matrix<Scalar, 3, 1> moment, force;
};

/// Accelerations of the points rho of a rigid body, A + W rho, and the inertial forces that they take.
///
/// The body's wrench, the sum of (rho x f, f) with f = (A + W rho) dm, is Y theta with theta its ten parameters:
///
///     force = m A + W h        moment = h x A + K (I_xx, ..., I_zz)
///
/// Of W, which for a motion is alpha^ + omega^ omega^, K takes the axial vector a of the skew part, and s of the other.
/// @realtime  no allocation, no throw
template <Real Scalar = double>
class AccelerationField {
 public:
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;

  AccelerationField() = default;

  /// @param A  of the origin, m/s^2
  /// @param W  of the points around it, 1/s^2
  AccelerationField(const Vector& A, const Matrix& W) noexcept
      : A_{A},
        W_{W},
        a_{(W(2, 1) - W(1, 2)) / 2, (W(0, 2) - W(2, 0)) / 2, (W(1, 0) - W(0, 1)) / 2},
        s_{(W(2, 1) + W(1, 2)) / 2, (W(0, 2) + W(2, 0)) / 2, (W(1, 0) + W(0, 1)) / 2} {}

  /// W = alpha^ + omega_r^ omega^.
  [[nodiscard]] static AccelerationField of(const Vector& A, const Vector& alpha, const Vector& omega_r,
                                            const Vector& omega) noexcept {
    Matrix W = omega * omega_r.transpose();
    W.diagonal().array() -= W.trace();
    W(2, 1) += alpha[0];
    W(1, 2) -= alpha[0];
    W(0, 2) += alpha[1];
    W(2, 0) -= alpha[1];
    W(1, 0) += alpha[2];
    W(0, 1) -= alpha[2];
    return {A, W};
  }

  /// Of the point at rho.
  [[nodiscard]] Vector at(const Vector& rho) const noexcept { return A_ + W_ * rho; }

  /// Y theta.
  [[nodiscard]] Wrench<Scalar> wrench(const BodyParameters<Scalar>& theta) const noexcept {
    const Vector h = theta.template segment<3>(1);
    const Scalar &xx = theta[4], &xy = theta[5], &xz = theta[6], &yy = theta[7], &yz = theta[8], &zz = theta[9];
    const Vector K_I(a_[0] * xx - W_(2, 0) * xy + W_(1, 0) * xz + (W_(1, 1) - W_(2, 2)) * yz + s_[0] * (zz - yy),
                     a_[1] * yy + W_(2, 1) * xy - W_(0, 1) * yz + (W_(2, 2) - W_(0, 0)) * xz + s_[1] * (xx - zz),
                     a_[2] * zz - W_(1, 2) * xz + W_(0, 2) * yz + (W_(0, 0) - W_(1, 1)) * xy + s_[2] * (yy - xx));
    return {h.cross(A_) + K_I, theta[0] * A_ + W_ * h};
  }

  /// Y' t: what each parameter contributes to the power of the wrench along a twist.
  [[nodiscard]] BodyParameters<Scalar> power(const Twist<Scalar>& t) const noexcept {
    const Vector& w = t.omega;
    const Scalar x = s_[0] * w[0], y = s_[1] * w[1], z = s_[2] * w[2];
    BodyParameters<Scalar> power;
    power << A_.dot(t.v), A_.cross(w) + W_.transpose() * t.v,  //
        a_[0] * w[0] + y - z, W_(2, 1) * w[1] - W_(2, 0) * w[0] + (W_(0, 0) - W_(1, 1)) * w[2],
        W_(1, 0) * w[0] - W_(1, 2) * w[2] + (W_(2, 2) - W_(0, 0)) * w[1],  //
        a_[1] * w[1] + z - x, W_(0, 2) * w[2] - W_(0, 1) * w[1] + (W_(1, 1) - W_(2, 2)) * w[0], a_[2] * w[2] + x - y;
    return power;
  }

 private:
  Vector A_;
  Matrix W_;
  Vector a_, s_;
};

}  // namespace limpid
