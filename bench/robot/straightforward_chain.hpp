// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/robot/body_inertia.hpp>
#include <limpid/robot/denavit_hartenberg.hpp>

#include <Eigen/Core>

#include <array>
#include <cmath>

namespace limpid::bench {

/// The equations of a chain of revolute joints as a textbook has them, in 6 x 6 matrices of spatial algebra, and its
/// regressor as a textbook computes it: one recursion of Newton and Euler for each parameter, with that parameter 1.
template <int N>
class StraightforwardChain {
 public:
  using Joints = Eigen::Matrix<double, N, 1>;
  using Parameters = Eigen::Matrix<double, 11 * N, 1>;
  using Regressor = Eigen::Matrix<double, N, 11 * N>;
  using Vector = Eigen::Matrix<double, 6, 1>;  // (omega, v) or (moment, force)
  using Matrix = Eigen::Matrix<double, 6, 6>;

  StraightforwardChain(const std::array<DenavitHartenberg<double>, N>& rows, const Eigen::Vector3d& gravity)
      : rows_{rows}, gravity_{gravity} {}

  void move_to(const Joints& q) {
    for (int i = 0; i < N; ++i) {
      const auto& [alpha, a, d, theta, joint] = rows_[index(i)];
      const double c = std::cos(theta + q[i]), s = std::sin(theta + q[i]), ca = std::cos(alpha), sa = std::sin(alpha);
      Eigen::Matrix3d R;
      R << c, -s, 0, s * ca, c * ca, -sa, s * sa, c * sa, ca;
      Matrix& X = X_[index(i)];
      X.setZero();
      X.topLeftCorner<3, 3>() = X.bottomRightCorner<3, 3>() = R.transpose();
      X.bottomLeftCorner<3, 3>() = -R.transpose() * hat({a, -d * sa, d * ca});
    }
  }

  /// H q_r'' + (C + B) q_r' + tau_g, with C by B(I, v) = ((v x*) I - I (v x) + (I v) xbar*) / 2.
  [[nodiscard]] Joints torque(const Parameters& parameters, const Joints& qdot, const Joints& qdot_r,
                              const Joints& qddot_r) const {
    Vector v = Vector::Zero(), v_r = Vector::Zero(), a_r = Vector::Zero();
    a_r.tail<3>() = -gravity_;
    const Vector S = Vector::Unit(2);
    std::array<Vector, N> f;
    for (int i = 0; i < N; ++i) {
      const Matrix I = inertia(parameters.template segment<10>(10 * i));
      v = X_[index(i)] * v + S * qdot[i];
      v_r = X_[index(i)] * v_r + S * qdot_r[i];
      a_r = X_[index(i)] * a_r + S * qddot_r[i] + motion_cross(v) * S * qdot_r[i];
      const Matrix B = (force_cross(v) * I - I * motion_cross(v) + bar_cross(I * v)) / 2;
      f[index(i)] = I * a_r + B * v_r;
    }
    Joints tau = parameters.template tail<N>().cwiseProduct(qdot_r);
    for (int i = N; i-- > 0;) {
      tau[i] += S.dot(f[index(i)]);
      if (i > 0) f[index(i - 1)] += X_[index(i)].transpose() * f[index(i)];
    }
    return tau;
  }

  [[nodiscard]] Regressor regressor(const Joints& qdot, const Joints& qdot_r, const Joints& qddot_r) const {
    Regressor phi;
    for (int p = 0; p < 11 * N; ++p) phi.col(p) = torque(Parameters::Unit(p), qdot, qdot_r, qddot_r);
    return phi;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  static Eigen::Matrix3d hat(const Eigen::Vector3d& x) {
    Eigen::Matrix3d hat;
    hat << 0, -x[2], x[1], x[2], 0, -x[0], -x[1], x[0], 0;
    return hat;
  }
  static Matrix motion_cross(const Vector& v) {
    Matrix cross = Matrix::Zero();
    cross.topLeftCorner<3, 3>() = cross.bottomRightCorner<3, 3>() = hat(v.head<3>());
    cross.bottomLeftCorner<3, 3>() = hat(v.tail<3>());
    return cross;
  }
  static Matrix force_cross(const Vector& v) { return -motion_cross(v).transpose(); }
  static Matrix bar_cross(const Vector& f) {
    Matrix cross = Matrix::Zero();
    cross.topLeftCorner<3, 3>() = -hat(f.head<3>());
    cross.topRightCorner<3, 3>() = cross.bottomLeftCorner<3, 3>() = -hat(f.tail<3>());
    return cross;
  }
  static Matrix inertia(const BodyParameters<double>& body) {
    Matrix I = body[0] * Matrix::Identity();
    I.topRightCorner<3, 3>() = hat(body.segment<3>(1));
    I.bottomLeftCorner<3, 3>() = -hat(body.segment<3>(1));
    I.topLeftCorner<3, 3>() << body[4], body[5], body[6], body[5], body[7], body[8], body[6], body[8], body[9];
    return I;
  }

  std::array<DenavitHartenberg<double>, N> rows_;
  Eigen::Vector3d gravity_;
  std::array<Matrix, N> X_;
};

}  // namespace limpid::bench
