// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>

#include <Eigen/Core>

#include <cmath>

namespace limpid {

/// The planar five-bar at one q: its kinematics and dynamics on sines and cosines that are computed once.
///
/// On side i the proximal link stands at the angle q_i and the distal one at phi_i, both from the x axis. With u_i
/// along the distal link and n_i a quarter turn ahead of it the tip x, l2 u_i from either elbow, moves by
///
///     u_i . x' = w_i q_i'                        w_i = l1 sin(phi_i - q_i)
///     n_i . x' = k_i q_i' + l2 phi_i'            k_i = l1 cos(phi_i - q_i)
///
/// the first of which give x' = J q', the second phi' = P q'. A distal link of mass m_d, its centre l_c from the elbow,
/// with inertia I_d about the elbow, moves as a mass m_d l_c/l2 at the tip, the rest of it at the elbow, and an inertia
/// E = I_d - m_d l_c l2 without mass (negative for a rod). So all is told by one mass m at the tip, and on each side
/// by the inertia I and first moment s about the base joint, E and the viscous friction b:
///
///     theta = (I1, I2, E1, E2, m, s1, s2, b1, b2)           kg m^2, kg, kg m, N m s/rad
///     H = diag(I) + P^T diag(E) P + m J^T J                 C = P^T diag(E) P' + m J^T J'
///
/// No entry of theta can be left out while there is gravity in the plane. H' = C + C^T, which is Property 2.
/// A non-finite argument, and joints at which the loop does not close, give a non-finite answer.
/// @realtime  no allocation, no throw
template <Real Scalar = double>
class FiveBarPose {
 public:
  using Vector = Eigen::Matrix<Scalar, 2, 1>;
  using Matrix = Eigen::Matrix<Scalar, 2, 2>;
  using Point = Eigen::Matrix<Scalar, 3, 1>;
  using Jacobian = Eigen::Matrix<Scalar, 3, 2>;
  using Parameters = Eigen::Matrix<Scalar, 9, 1>;
  using Regressor = Eigen::Matrix<Scalar, 2, 9>;

  struct Links {
    Scalar base;  ///< between the base joints, m
    Scalar l1;    ///< proximal, m
    Scalar l2;    ///< distal, m
    Vector g;     ///< acceleration of gravity, in the plane, m/s^2
  };

  /// @param c, s  cosines and sines of q1 and q2
  FiveBarPose(const Links& links, const Vector& c, const Vector& s) noexcept : links_{links} {
    using std::sqrt;
    const Scalar &l1 = links.l1, &l2 = links.l2;
    const Vector d(links.base + l1 * (c[1] - c[0]), l1 * (s[1] - s[0]));  // from elbow 1 to elbow 2
    const Scalar square = d.squaredNorm(), height = sqrt(l2 * l2 / square - Scalar(1) / Scalar(4));  // per |d|
    const Vector up(-height * d[1], height * d[0]), aside = d / Scalar(2);
    x_ = l1 / Scalar(2) * Vector(c[0] + c[1], s[0] + s[1]) + up;
    ux_ = Vector(up[0] + aside[0], up[0] - aside[0]) / l2;
    uy_ = Vector(up[1] + aside[1], up[1] - aside[1]) / l2;
    w_ = l1 * (c.cwiseProduct(uy_) - s.cwiseProduct(ux_));
    k_ = l1 * (c.cwiseProduct(ux_) + s.cwiseProduct(uy_));
    per_sine_ = l2 * l2 / (height * square);
    cosine_ = (up.squaredNorm() - aside.squaredNorm()) / (l2 * l2);
    weight_ = s * links.g[0] - c * links.g[1];
  }

  /// Tip in the base frame, m; z is 0: the plane is x-y.
  [[nodiscard]] Point position() const noexcept { return {x_[0], x_[1], Scalar(0)}; }

  /// J, m/rad.
  [[nodiscard]] Jacobian jacobian() const noexcept { return in_space(planar_jacobian()); }

  /// J', m/(rad s).
  [[nodiscard]] Jacobian jacobian_dot(const Vector& qdot) const noexcept {
    return in_space(tip_rates(along_dot(qdot, distal_rates(qdot))));
  }

  /// Angles between the links, by their sines: of distal link 2 against 1, of each distal against its proximal link.
  /// The first is 0 where the device cannot hold its tip, the others where it cannot move it; at elbows that point
  /// outward and a tip ahead of them they are > 0, < 0, > 0.
  [[nodiscard]] Point sines() const noexcept { return {Scalar(1) / per_sine_, w_[0] / links_.l1, w_[1] / links_.l1}; }

  /// Inertia, kg m^2.
  [[nodiscard]] Matrix H(const Parameters& theta) const noexcept {
    const Matrix J = planar_jacobian(), P = distal_jacobian();
    const auto entry = [&](int i, int j) {
      return theta[2] * P(0, i) * P(0, j) + theta[3] * P(1, i) * P(1, j) + theta[4] * J.col(i).dot(J.col(j));
    };
    const Scalar h12 = entry(0, 1);
    Matrix H;
    H << theta[0] + entry(0, 0), h12,  //
        h12, theta[1] + entry(1, 1);
    return H;
  }

  /// Coriolis and centrifugal matrix, N m s/rad, the one with Property 2.
  [[nodiscard]] Matrix C(const Parameters& theta, const Vector& qdot) const noexcept {
    const Vector phidot = distal_rates(qdot);
    const Matrix along = along_dot(qdot, phidot);
    Matrix Pdot = across(along);  // l2 phi'' = n . x'' - k q'' - w q'^2
    Pdot.diagonal() -= w_.cwiseProduct(qdot);
    Pdot /= links_.l2;
    return distal_jacobian().transpose() * theta.template segment<2>(2).asDiagonal() * Pdot +
           theta[4] * planar_jacobian().transpose() * tip_rates(along);
  }

  /// Viscous friction, N m s/rad; diagonal.
  [[nodiscard]] Matrix B(const Parameters& theta) const noexcept { return theta.template tail<2>().asDiagonal(); }

  /// Gravity torque, N m.
  [[nodiscard]] Vector tau_g(const Parameters& theta) const noexcept {
    return theta.template segment<2>(5).cwiseProduct(weight_) - theta[4] * joint_torque(links_.g);
  }

  /// phi, with phi theta = H q'' + (C + B) q' + tau_g. Eq. (3.16).
  [[nodiscard]] Regressor regressor(const Vector& qdot, const Vector& qddot) const noexcept {
    return regressor(qdot, qdot, qddot);
  }

  /// phi_r, with phi_r theta = H q_r'' + (C + B) q_r' + tau_g. Eq. (3.27).
  [[nodiscard]] Regressor regressor(const Vector& qdot, const Vector& qdot_r, const Vector& qddot_r) const noexcept {
    const Motion motion = reference_motion(qdot, qdot_r, qddot_r);
    Regressor dense;
    dense.template leftCols<2>() = qddot_r.asDiagonal();
    dense.template middleCols<2>(2) = distal_jacobian().transpose() * motion.phiddot.asDiagonal();
    dense.col(4) = joint_torque(motion.a);
    dense.template middleCols<2>(5) = weight_.asDiagonal();
    dense.template rightCols<2>() = qdot_r.asDiagonal();
    return dense;
  }

  /// phi_r theta, N m, without phi_r.
  [[nodiscard]] Vector torque(const Parameters& theta, const Vector& qdot, const Vector& qdot_r,
                              const Vector& qddot_r) const noexcept {
    const Motion motion = reference_motion(qdot, qdot_r, qddot_r);
    const Vector turning = theta.template segment<2>(2).cwiseProduct(motion.phiddot);
    return theta.template head<2>().cwiseProduct(qddot_r) + joint_torque(theta[4] * motion.a) +
           joint_torque_of_turning(turning) + theta.template segment<2>(5).cwiseProduct(weight_) +
           theta.template tail<2>().cwiseProduct(qdot_r);
  }

  /// phi_r' delta of the adaptation law (4.8), without phi_r; delta in rad/s.
  [[nodiscard]] Parameters adaptation_direction(const Vector& qdot, const Vector& qdot_r, const Vector& qddot_r,
                                                const Vector& delta) const noexcept {
    const Motion motion = reference_motion(qdot, qdot_r, qddot_r);
    Parameters direction;
    direction.template head<2>() = qddot_r.cwiseProduct(delta);
    direction.template segment<2>(2) = motion.phiddot.cwiseProduct(distal_rates(delta));
    direction[4] = motion.a.dot(tip_rate(w_.cwiseProduct(delta)));
    direction.template segment<2>(5) = weight_.cwiseProduct(delta);
    direction.template tail<2>() = qdot_r.cwiseProduct(delta);
    return direction;
  }

 private:
  // What q_r'' and q_r' ask for on the motion q'.
  struct Motion {
    Vector a;        // J q_r'' + J' q_r' - g, m/s^2
    Vector phiddot;  // P q_r'' + P' q_r', rad/s^2
  };

  [[nodiscard]] Motion reference_motion(const Vector& qdot, const Vector& qdot_r,
                                        const Vector& qddot_r) const noexcept {
    const Vector phidot = distal_rates(qdot), across_r = across(Vector(w_.cwiseProduct(qdot_r)));
    const Vector along = w_.cwiseProduct(qddot_r) + k_.cwiseProduct(phidot - qdot).cwiseProduct(qdot_r) -
                         phidot.cwiseProduct(across_r);  // u . x'' = w q'' + w' q' - phi' n . x'
    const Vector turned = across(along) - k_.cwiseProduct(qddot_r) - w_.cwiseProduct(qdot).cwiseProduct(qdot_r);
    return {tip_rate(along) - links_.g, turned / links_.l2};
  }

  // x' from u_i . x' = along_i.
  [[nodiscard]] Vector tip_rate(const Vector& along) const noexcept {
    return per_sine_ * Vector(uy_[1] * along[0] - uy_[0] * along[1], ux_[0] * along[1] - ux_[1] * along[0]);
  }

  // n_i . x' from u_i . x' = along_i; by columns.
  template <typename Derived>
  [[nodiscard]] typename Derived::PlainObject across(const Eigen::MatrixBase<Derived>& along) const noexcept {
    Matrix turn;
    turn << -cosine_, Scalar(1),  //
        Scalar(-1), cosine_;
    return per_sine_ * (turn * along);
  }

  // phi' = P q', rad/s.
  [[nodiscard]] Vector distal_rates(const Vector& qdot) const noexcept {
    return (across(Vector(w_.cwiseProduct(qdot))) - k_.cwiseProduct(qdot)) / links_.l2;
  }

  // J^T F, N m.
  [[nodiscard]] Vector joint_torque(const Vector& F) const noexcept {
    return per_sine_ * w_.cwiseProduct(Vector(uy_[1] * F[0] - ux_[1] * F[1], ux_[0] * F[1] - uy_[0] * F[0]));
  }

  // P^T moment, N m.
  [[nodiscard]] Vector joint_torque_of_turning(const Vector& moment) const noexcept {
    const Vector turned(-cosine_ * moment[0] - moment[1], moment[0] + cosine_ * moment[1]);
    return (per_sine_ * w_.cwiseProduct(turned) - k_.cwiseProduct(moment)) / links_.l2;
  }

  [[nodiscard]] Matrix tip_rates(const Matrix& along) const noexcept {
    Matrix columns;
    columns << tip_rate(along.col(0)), tip_rate(along.col(1));
    return columns;
  }

  [[nodiscard]] Matrix planar_jacobian() const noexcept { return tip_rates(w_.asDiagonal()); }

  [[nodiscard]] Matrix distal_jacobian() const noexcept {
    Matrix P = across(Matrix(w_.asDiagonal()));
    P.diagonal() -= k_;
    return P / links_.l2;
  }

  // u_i . J', by columns.
  [[nodiscard]] Matrix along_dot(const Vector& qdot, const Vector& phidot) const noexcept {
    Matrix along = -(phidot.asDiagonal() * across(Matrix(w_.asDiagonal())));
    along.diagonal() += k_.cwiseProduct(phidot - qdot);
    return along;
  }

  [[nodiscard]] static Jacobian in_space(const Matrix& planar) noexcept {
    Jacobian J;
    J << planar, Scalar(0), Scalar(0);
    return J;
  }

  Links links_;
  Vector x_;         // tip, m
  Vector ux_, uy_;   // u_1 and u_2, by components
  Vector w_, k_;     // m
  Scalar per_sine_;  // 1/sin(phi_2 - phi_1)
  Scalar cosine_;    // cos(phi_2 - phi_1)
  Vector weight_;    // -g . (derivative of the proximal link's direction), m/s^2
};

}  // namespace limpid
