// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>

#include <cmath>

namespace limpid::bench {

/// The Omni's equations as they are printed, with Eigen's inverse, on a scalar of any kind.
template <typename Scalar>
class PrintedOmni {
 public:
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  using Regressor = Eigen::Matrix<Scalar, 3, 9>;

  /// (3.3)-(3.6), (3.12), (3.14)
  /// @return  q, q', q'' in columns
  [[nodiscard]] Matrix inverse(const Vector& x, const Vector& v, const Vector& a) const {
    using std::acos, std::atan2, std::sqrt, std::sin, std::cos;
    const Scalar r = sqrt(Scalar(x[0] * x[0] + x[1] * x[1]));
    const Scalar q3 = acos(Scalar((l2 * l2 + l3 * l3 - r * r - x[2] * x[2]) / (2 * l2 * l3))) - acos(Scalar(-1));
    const Vector q(atan2(x[1], x[0]), atan2(x[2], r) + atan2(Scalar(-l3 * sin(q3)), Scalar(l2 + l3 * cos(q3))), q3);
    const Matrix to_joints = jacobian(q).inverse();
    const Vector qdot = to_joints * v;
    const Vector qddot = to_joints * (a - jacobian_dot(q, qdot) * qdot);
    Matrix columns;
    columns << q, qdot, qddot;
    return columns;
  }

  /// (3.9)
  [[nodiscard]] Matrix jacobian(const Vector& q) const {
    const auto [c1, s1, c23, s23, r, z] = parts(q);
    const Scalar o(0);
    Matrix J;
    J << -r * s1, -z * c1, -l3 * c1 * s23, r * c1, -z * s1, -l3 * s1 * s23, o, r, l3 * c23;
    return J;
  }

  /// (3.11)
  [[nodiscard]] Matrix jacobian_dot(const Vector& q, const Vector& qdot) const {
    const auto [c1, s1, c23, s23, r, z] = parts(q);
    const Scalar o(0);
    Matrix X, Y, Z, J;
    X << -r * c1, z * s1, l3 * s1 * s23, z * s1, -r * c1, -l3 * c1 * c23, l3 * s1 * s23, -l3 * c1 * c23, -l3 * c1 * c23;
    Y << r * s1, z * c1, l3 * c1 * s23, z * c1, r * s1, l3 * s1 * c23, l3 * c1 * s23, l3 * s1 * c23, l3 * s1 * c23;
    Z << o, o, o, o, z, l3 * s23, o, l3 * s23, l3 * s23;
    J << qdot.transpose() * X, -qdot.transpose() * Y, -qdot.transpose() * Z;
    return J;
  }

  /// (3.28)
  [[nodiscard]] Regressor regressor(const Vector& q, const Vector& v, const Vector& vr, const Vector& ar) const {
    using std::cos, std::sin;
    const Scalar c2 = cos(q[1]), s2 = sin(q[1]), c3 = cos(q[2]), s3 = sin(q[2]), q23 = q[1] + q[2], q223 = q[1] + q23;
    const Scalar c23 = cos(q23), s23 = sin(q23), s223 = sin(q223), o(0);
    Regressor phi;
    phi << ar[0], c2 * c2 * ar[0] - c2 * s2 * (v[1] * vr[0] + v[0] * vr[1]),
        c23 * c23 * ar[0] - c23 * s23 * (vr[0] * (v[1] + v[2]) + v[0] * (vr[1] + vr[2])),
        2 * c2 * c23 * ar[0] - s223 * (vr[0] * v[1] + v[0] * vr[1]) - c2 * s23 * (vr[0] * v[2] + v[0] * vr[2]), o, o,
        vr[0], o, o,  //
        o, ar[1] + c2 * s2 * v[0] * vr[0], ar[1] + ar[2] + c23 * s23 * v[0] * vr[0],
        2 * c3 * ar[1] + c3 * ar[2] + s223 * v[0] * vr[0] - s3 * ((vr[1] + vr[2]) * v[2] + v[1] * vr[2]), g * c2,
        g * c23, o, vr[1], o,  //
        o, o, ar[1] + ar[2] + c23 * s23 * v[0] * vr[0], c3 * ar[1] + c2 * s23 * v[0] * vr[0] + s3 * v[1] * vr[1], o,
        g * c23, o, o, vr[2];
    return phi;
  }

 private:
  struct Parts {
    Scalar c1, s1, c23, s23, r, z;
  };

  [[nodiscard]] Parts parts(const Vector& q) const {
    using std::cos, std::sin;
    const Scalar q23 = q[1] + q[2], c23 = cos(q23), s23 = sin(q23);
    return {cos(q[0]), sin(q[0]), c23, s23, l2 * cos(q[1]) + l3 * c23, l2 * sin(q[1]) + l3 * s23};
  }

  Scalar l2 = Scalar(135) / Scalar(1000), l3 = Scalar(130) / Scalar(1000), g = Scalar(981) / Scalar(100);
};

}  // namespace limpid::bench
