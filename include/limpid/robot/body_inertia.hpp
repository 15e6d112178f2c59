// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <cmath>

namespace limpid {

/// What a rigid body is to its dynamics, linearly: (m, m c_x, m c_y, m c_z, I_xx, I_xy, I_xz, I_yy, I_yz, I_zz), with c
/// its centre of mass and I its inertia about the origin of a frame in which it rests; kg, kg m, kg m^2. The parameters
/// of bodies that are fixed to each other add up.
template <Real Scalar = double>
using BodyParameters = Eigen::Matrix<Scalar, 10, 1>;

/// A body's parameters as the mass m, the first moments h = m c and the inertia matrix I about the origin.
template <Real Scalar = double>
struct BodyInertia {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;

  Scalar m;  ///< kg
  Vector h;  ///< kg m
  Matrix I;  ///< kg m^2, symmetric

  [[nodiscard]] static BodyInertia of(const BodyParameters<Scalar>& body) noexcept {
    Matrix I;
    I << body[4], body[5], body[6],  //
        body[5], body[7], body[8],   //
        body[6], body[8], body[9];
    return {body[0], body.template segment<3>(1), I};
  }

  [[nodiscard]] BodyParameters<Scalar> parameters() const noexcept {
    BodyParameters<Scalar> body;
    body << m, h, I(0, 0), I(0, 1), I(0, 2), I(1, 1), I(1, 2), I(2, 2);
    return body;
  }

  /// The same body seen from a frame in which its own lies at p, turned by R; the parallel axis theorem.
  /// @realtime  no allocation, no throw
  [[nodiscard]] BodyInertia seen_from(const Matrix& R, const Vector& p) const noexcept {
    const Vector turned = R * h, across = m * p + turned;
    Matrix moved = R * I * R.transpose();
    moved.diagonal().array() += p.dot(across + turned);
    moved -= p * turned.transpose() + across * p.transpose();
    return {m, across, moved};
  }

  BodyInertia& operator+=(const BodyInertia& other) noexcept {
    m += other.m;
    h += other.h;
    I += other.I;
    return *this;
  }
};

/// A body by its mass, kg, its centre of mass, m, and its inertia about that centre, kg m^2.
template <Real Scalar>
[[nodiscard]] BodyParameters<Scalar> rigid_body(const Scalar& mass, const Eigen::Matrix<Scalar, 3, 1>& centre,
                                                const Eigen::Matrix<Scalar, 3, 3>& inertia) noexcept {
  using Body = BodyInertia<Scalar>;
  const typename Body::Matrix unturned = Body::Matrix::Identity();
  return Body{mass, Body::Vector::Zero(), inertia}.seen_from(unturned, centre).parameters();
}

/// A uniform rod of no thickness between two points, m.
template <Real Scalar>
[[nodiscard]] BodyParameters<Scalar> slender_rod(const Scalar& mass, const Eigen::Matrix<Scalar, 3, 1>& from,
                                                 const Eigen::Matrix<Scalar, 3, 1>& to) noexcept {
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  const Eigen::Matrix<Scalar, 3, 1> along = to - from, centre = (from + to) / Scalar(2);
  const Matrix inertia = (along.squaredNorm() * Matrix::Identity() - along * along.transpose()) * (mass / Scalar(12));
  return rigid_body(mass, centre, inertia);
}

/// Whether some distribution of mass has these parameters, with volume: the second moments of mass of order 0 to 2 are
/// then positive definite (Wensing, Kim and Slotine 2018). Points, rods and plates are on the border of that set, which
/// `slack`, added to the mass and the second moments, takes in. Off line.
template <Real Scalar>
[[nodiscard]] bool is_physical(const BodyParameters<Scalar>& body, const Scalar& slack = Scalar(0)) noexcept {
  const auto b = BodyInertia<Scalar>::of(body);
  Eigen::Matrix<Scalar, 4, 4> moments = slack * Eigen::Matrix<Scalar, 4, 4>::Identity();
  moments.template topLeftCorner<3, 3>() -= b.I;
  moments.template topLeftCorner<3, 3>().diagonal().array() += b.I.trace() / Scalar(2);
  moments.template topRightCorner<3, 1>() += b.h;
  moments.template bottomLeftCorner<1, 3>() += b.h.transpose();
  moments(3, 3) += b.m;
  return moments.llt().info() == Eigen::Success;
}

}  // namespace limpid
