// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

namespace limpid {

/// The Phantom Omni at one q: (3.2), (3.9), (3.11), (3.21)-(3.28), on sines and cosines that are computed once.
///
/// theta = (I1, m2 lc2^2 + I2 + m3 l2^2, m3 lc3^2 + I3, m3 l2 lc3, m2 lc2 + m3 l2, m3 lc3, b1, b2, b3) as in (3.25),
/// in kg m^2, kg m and N m s/rad. A non-finite argument gives a non-finite answer.
/// @realtime  no allocation, no throw; J 10 flops, J' 40, torque and adaptation_direction 100 together
template <Real Scalar = double>
class OmniPose {
 public:
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  using Parameters = Eigen::Matrix<Scalar, 9, 1>;
  using Regressor = Eigen::Matrix<Scalar, 3, 9>;

  struct Links {
    Scalar l2;  ///< m
    Scalar l3;  ///< m
    Scalar g;   ///< acceleration of gravity, along -z, m/s^2
  };

  /// Cosines and sines of q1, q2 and q2 + q3.
  struct Angles {
    Scalar c1, s1, c2, s2, c23, s23;
  };

  OmniPose(const Links& links, const Angles& angles) noexcept
      : links_{links},
        angles_{angles},
        r_{links.l2 * angles.c2 + links.l3 * angles.c23},
        z_{links.l2 * angles.s2 + links.l3 * angles.s23} {}

  /// Tip in the base frame, m. Eq. (3.2).
  [[nodiscard]] Vector position() const noexcept { return {r_ * angles_.c1, r_ * angles_.s1, z_}; }

  /// J, m/rad. Eq. (3.9).
  [[nodiscard]] Matrix jacobian() const noexcept {
    const auto& [c1, s1, c2, s2, c23, s23] = angles_;
    const Scalar &r = r_, &z = z_, &l3 = links_.l3;
    Matrix J;
    J << -r * s1, -z * c1, -l3 * c1 * s23,  //
        r * c1, -z * s1, -l3 * s1 * s23,    //
        Scalar(0), r, l3 * c23;
    return J;
  }

  /// J' F, N m, of a force on the tip, N, base frame; without J's zeros and sums of products.
  [[nodiscard]] Vector torque_of(const Vector& F) const noexcept {
    const auto& [c1, s1, c2, s2, c23, s23] = angles_;
    const Scalar outward = c1 * F[0] + s1 * F[1], around = c1 * F[1] - s1 * F[0];
    return {r_ * around, r_ * F[2] - z_ * outward, links_.l3 * (c23 * F[2] - s23 * outward)};
  }

  /// J', m/(rad s). Eq. (3.11): (3.9) differentiated by the product rule, which is the same with fewer products.
  [[nodiscard]] Matrix jacobian_dot(const Vector& qdot) const noexcept {
    const auto& [c1, s1, c2, s2, c23, s23] = angles_;
    const Scalar &r = r_, &z = z_, &q1dot = qdot[0];
    const Scalar x3 = links_.l3 * c23, z3 = links_.l3 * s23;  // the third link, in the plane of the arm
    const Scalar rdot = -z * qdot[1] - z3 * qdot[2], zdot = r * qdot[1] + x3 * qdot[2];
    const Scalar x3dot = -z3 * (qdot[1] + qdot[2]), z3dot = x3 * (qdot[1] + qdot[2]);
    Matrix Jdot;
    Jdot << -rdot * s1 - r * c1 * q1dot, -zdot * c1 + z * s1 * q1dot, -z3dot * c1 + z3 * s1 * q1dot,  //
        rdot * c1 - r * s1 * q1dot, -zdot * s1 - z * c1 * q1dot, -z3dot * s1 - z3 * c1 * q1dot,       //
        Scalar(0), rdot, x3dot;
    return Jdot;
  }

  /// Inertia, kg m^2. Eq. (3.21).
  [[nodiscard]] Matrix H(const Parameters& theta) const noexcept {
    const auto& [c1, s1, c2, s2, c23, s23] = angles_;
    const Scalar h11 = theta[0] + theta[1] * c2 * c2 + theta[2] * c23 * c23 + 2 * theta[3] * c2 * c23;
    const Scalar h22 = theta[1] + theta[2] + 2 * theta[3] * c3();
    const Scalar h23 = theta[2] + theta[3] * c3();
    const Scalar h33 = theta[2];
    const Scalar o(0);
    Matrix H;
    H << h11, o, o,   //
        o, h22, h23,  //
        o, h23, h33;
    return H;
  }

  /// Coriolis and centrifugal matrix, N m s/rad, the one with Property 2. Eq. (3.22).
  [[nodiscard]] Matrix C(const Parameters& theta, const Vector& qdot) const noexcept {
    const auto& [c1, s1, c2, s2, c23, s23] = angles_;
    const Scalar a1 = theta[1] * c2 * s2 + theta[2] * c23 * s23 + theta[3] * s223();
    const Scalar a2 = theta[2] * c23 * s23 + theta[3] * c2 * s23;
    const Scalar a3 = theta[3] * s3();
    Matrix C;
    C << -(a1 * qdot[1] + a2 * qdot[2]), -a1 * qdot[0], -a2 * qdot[0],  //
        a1 * qdot[0], -a3 * qdot[2], -a3 * (qdot[1] + qdot[2]),         //
        a2 * qdot[0], a3 * qdot[1], Scalar(0);
    return C;
  }

  /// Viscous friction, N m s/rad; diagonal. Eq. (3.24).
  [[nodiscard]] Matrix B(const Parameters& theta) const noexcept { return theta.template tail<3>().asDiagonal(); }

  /// Gravity torque, N m. Eq. (3.23).
  [[nodiscard]] Vector tau_g(const Parameters& theta) const noexcept {
    const Scalar g2 = links_.g * angles_.c2, g23 = links_.g * angles_.c23;
    return {Scalar(0), theta[4] * g2 + theta[5] * g23, theta[5] * g23};
  }

  /// phi, with phi theta = H q'' + (C + B) q' + tau_g. Eq. (3.26); the q1'' that its print lacks in row 1, column 4 is
  /// here, because (3.26) is (3.28) with the reference on the motion.
  [[nodiscard]] Regressor regressor(const Vector& qdot, const Vector& qddot) const noexcept {
    return regressor(qdot, qdot, qddot);
  }

  /// phi_r, with phi_r theta = H q_r'' + (C + B) q_r' + tau_g. Eq. (3.28).
  [[nodiscard]] Regressor regressor(const Vector& qdot, const Vector& qdot_r, const Vector& qddot_r) const noexcept {
    const Columns phi = columns(qdot, qdot_r, qddot_r);
    const Scalar o(0);
    Regressor dense;
    dense << qddot_r[0], phi.r12, phi.r13, phi.r14, o, o, qdot_r[0], o, o,  //
        o, phi.r22, phi.r23, phi.r24, phi.r25, phi.r26, o, qdot_r[1], o,    //
        o, o, phi.r23, phi.r34, o, phi.r26, o, o, qdot_r[2];
    return dense;
  }

  /// phi_r theta, N m, without phi_r's zeros.
  [[nodiscard]] Vector torque(const Parameters& theta, const Vector& qdot, const Vector& qdot_r,
                              const Vector& qddot_r) const noexcept {
    const Columns phi = columns(qdot, qdot_r, qddot_r);
    return {qddot_r[0] * theta[0] + phi.r12 * theta[1] + phi.r13 * theta[2] + phi.r14 * theta[3] + qdot_r[0] * theta[6],
            phi.r22 * theta[1] + phi.r23 * theta[2] + phi.r24 * theta[3] + phi.r25 * theta[4] + phi.r26 * theta[5] +
                qdot_r[1] * theta[7],
            phi.r23 * theta[2] + phi.r34 * theta[3] + phi.r26 * theta[5] + qdot_r[2] * theta[8]};
  }

  /// phi_r' delta of the adaptation law (4.8), without phi_r's zeros; delta in rad/s.
  [[nodiscard]] Parameters adaptation_direction(const Vector& qdot, const Vector& qdot_r, const Vector& qddot_r,
                                                const Vector& delta) const noexcept {
    const Columns phi = columns(qdot, qdot_r, qddot_r);
    Parameters direction;
    direction << qddot_r[0] * delta[0],                                    //
        phi.r12 * delta[0] + phi.r22 * delta[1],                           //
        phi.r13 * delta[0] + phi.r23 * (delta[1] + delta[2]),              //
        phi.r14 * delta[0] + phi.r24 * delta[1] + phi.r34 * delta[2],      //
        phi.r25 * delta[1],                                                //
        phi.r26 * (delta[1] + delta[2]),                                   //
        qdot_r[0] * delta[0], qdot_r[1] * delta[1], qdot_r[2] * delta[2];  //
    return direction;
  }

 private:
  // The entries of (3.28) that are not zero and not plain inputs; r33 = r23 and r36 = r26.
  struct Columns {
    Scalar r12, r13, r14, r22, r23, r24, r25, r26, r34;
  };

  [[nodiscard]] Columns columns(const Vector& qdot, const Vector& qdot_r, const Vector& qddot_r) const noexcept {
    const auto& [c1, s1, c2, s2, c23, s23] = angles_;
    const Scalar &q1 = qdot[0], &q2 = qdot[1], &q3 = qdot[2];           // q'
    const Scalar &v1 = qdot_r[0], &v2 = qdot_r[1], &v3 = qdot_r[2];     // q_r'
    const Scalar &w1 = qddot_r[0], &w2 = qddot_r[1], &w3 = qddot_r[2];  // q_r''
    const Scalar c3 = this->c3(), s3 = this->s3(), s223 = this->s223();
    const Scalar around2 = v1 * q2 + q1 * v2, around3 = v1 * q3 + q1 * v3, around1 = q1 * v1;
    return {
        .r12 = c2 * c2 * w1 - c2 * s2 * around2,
        .r13 = c23 * c23 * w1 - c23 * s23 * (around2 + around3),
        .r14 = 2 * c2 * c23 * w1 - s223 * around2 - c2 * s23 * around3,
        .r22 = w2 + c2 * s2 * around1,
        .r23 = w2 + w3 + c23 * s23 * around1,
        .r24 = 2 * c3 * w2 + c3 * w3 + s223 * around1 - s3 * ((v2 + v3) * q3 + q2 * v3),
        .r25 = links_.g * c2,
        .r26 = links_.g * c23,
        .r34 = c3 * w2 + c2 * s23 * around1 + s3 * q2 * v2,
    };
  }

  [[nodiscard]] Scalar c3() const noexcept { return angles_.c2 * angles_.c23 + angles_.s2 * angles_.s23; }
  [[nodiscard]] Scalar s3() const noexcept { return angles_.c2 * angles_.s23 - angles_.s2 * angles_.c23; }
  [[nodiscard]] Scalar s223() const noexcept { return angles_.s2 * angles_.c23 + angles_.c2 * angles_.s23; }

  Links links_;
  Angles angles_;
  Scalar r_;  // tip from the vertical axis, eq. (3.4), m
  Scalar z_;  // tip above the base frame, m
};

}  // namespace limpid
