// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/real.hpp>
#include <limpid/robot/acceleration_field.hpp>
#include <limpid/robot/body_inertia.hpp>
#include <limpid/robot/denavit_hartenberg.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>

namespace limpid {

/// A serial chain at one q, on sines and cosines that are computed once.
///
/// theta = (ten BodyParameters of link 1 in its frame, ..., of link N, b_1, ..., b_N), with b the viscous frictions.
/// Each point P of mass dm of the links adds J_P' J_P dm to H and J_P' (dJ_P/dt) dm to C, so that H' = C + C' holds
/// point by point. This C is that of Christoffel's symbols, which Echeandia and Wensing (2021) write with a link's B(I,
/// v) = ((v x*) I - I (v x) + (I v) xbar*) / 2; from it, link k feels at rho the acceleration
///
///     A_r + W_r rho,   W_r = alpha_r^ + omega_r^ omega^
///
/// with alpha_r, omega_r, A_r those that q_r', q_r'' give to its frame, A_r with -g on top. They are carried from link
/// to link, and each of the link's parameters acts through them: no product with a zero of phi_r is formed.
///
/// Not all parameters act, and some act only in sums with others: theta is not identifiable, phi_r theta is.
/// @realtime  no allocation, no throw; torque and regressor once over the links, C once for each joint
template <int N, Real Scalar = double>
class SerialChainPose {
 public:
  static constexpr int parameters = 11 * N;
  using Joints = Eigen::Matrix<Scalar, N, 1>;
  using Parameters = Eigen::Matrix<Scalar, parameters, 1>;
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Rotation = Eigen::Matrix<Scalar, 3, 3>;
  using Jacobian = Eigen::Matrix<Scalar, 3, N>;
  using Matrix = Eigen::Matrix<Scalar, N, N>;
  using Regressor = Eigen::Matrix<Scalar, N, parameters>;
  using Frames = std::array<RigidTransform<Scalar>, static_cast<std::size_t>(N)>;

  struct Fixed {
    Joints turns;    ///< 1 for a revolute joint, 0 for a prismatic one
    Vector tip;      ///< in the last frame, m
    Vector gravity;  ///< in the base frame, m/s^2
  };

  /// @param frames  each in the one before, the first in the base frame
  SerialChainPose(const Fixed& fixed, const Frames& frames) noexcept : fixed_{fixed}, frames_{frames} {}

  /// Tip in the base frame, m.
  [[nodiscard]] Vector position() const noexcept {
    Vector x = fixed_.tip;
    for (int i = N; i-- > 0;) x = frame(i) * x;
    return x;
  }

  /// From the last frame, in which the tip rests, into the base frame.
  [[nodiscard]] Rotation rotation() const noexcept {
    Rotation R = frame(0).R;
    for (int i = 1; i < N; ++i) R = R * frame(i).R;
    return R;
  }

  /// J, m/rad: z_i x (x - o_i) where joint i turns, z_i where it slides.
  [[nodiscard]] Jacobian jacobian() const noexcept {
    const Axes axes = axes_in_base();
    Jacobian J;
    for (int i = 0; i < N; ++i) {
      const auto& [z, o] = axes.of[index(i)];
      column(J, i) = turns(i) * z.cross(axes.x - o) + slides(i) * z;
    }
    return J;
  }

  /// Of the tip's angular velocity, base frame: z_i where joint i turns, else 0.
  [[nodiscard]] Jacobian angular_jacobian() const noexcept {
    const Axes axes = axes_in_base();
    Jacobian J;
    for (int i = 0; i < N; ++i) column(J, i) = turns(i) * axes.of[index(i)].z;
    return J;
  }

  /// J', m/(rad s).
  [[nodiscard]] Jacobian jacobian_dot(const Joints& qdot) const noexcept {
    const Axes axes = axes_in_base();
    std::array<Axis, static_cast<std::size_t>(N)> rates;  // of the axes
    Twist<Scalar> link{Vector::Zero(), Vector::Zero()};
    Vector origin = Vector::Zero();  // the point of the link that has its velocity
    for (int i = 0; i < N; ++i) {
      const auto& [z, o] = axes.of[index(i)];
      link.v += link.omega.cross(o - origin) + slides(i) * qdot[i] * z;
      link.omega += turns(i) * qdot[i] * z;
      rates[index(i)] = {link.omega.cross(z), link.v};
      origin = o;
    }
    const Vector x_dot = link.v + link.omega.cross(axes.x - origin);
    Jacobian Jdot;
    for (int i = 0; i < N; ++i) {
      const auto& [z, o] = axes.of[index(i)];
      const auto& [z_dot, o_dot] = rates[index(i)];
      column(Jdot, i) = turns(i) * (z_dot.cross(axes.x - o) + z.cross(x_dot - o_dot)) + slides(i) * z_dot;
    }
    return Jdot;
  }

  /// Inertia, kg m^2: joint i carries links i to N as one body (Walker and Orin 1982).
  [[nodiscard]] Matrix H(const Parameters& theta) const noexcept {
    Matrix H;
    auto carried = BodyInertia<Scalar>::of(link(theta, N - 1));
    for (int i = N; i-- > 0;) {
      const Vector z = Vector::UnitZ(), h_x_z = carried.h.cross(z);
      Wrench<Scalar> wrench{turns(i) * carried.I.col(2) + slides(i) * h_x_z,
                            slides(i) * carried.m * z - turns(i) * h_x_z};
      for (int j = i; j >= 0; --j) {
        H(i, j) = H(j, i) = joint_effort(j, wrench);
        wrench = carried_down(j, wrench);
      }
      if (i == 0) break;
      carried = carried.seen_from(frame(i).R, frame(i).p);
      carried += BodyInertia<Scalar>::of(link(theta, i - 1));
    }
    return H;
  }

  /// Coriolis and centrifugal matrix, N m s/rad, the one with Property 2, which is that of Christoffel's symbols.
  [[nodiscard]] Matrix C(const Parameters& theta, const Joints& qdot) const noexcept {
    Parameters frictionless = theta;
    frictionless.template tail<N>().setZero();
    Matrix C;
    for (int j = 0; j < N; ++j) {
      const Fields motion = fields(Vector::Zero(), qdot, Joints::Unit(j), Joints::Zero());
      C.col(j) = effort(motion, frictionless, Joints::Zero());
    }
    return C;
  }

  /// Viscous friction, N m s/rad; diagonal.
  [[nodiscard]] Matrix B(const Parameters& theta) const noexcept { return theta.template tail<N>().asDiagonal(); }

  /// Gravity torque, N m.
  [[nodiscard]] Joints tau_g(const Parameters& theta) const noexcept {
    const Joints rest = Joints::Zero();
    return effort(fields(-fixed_.gravity, rest, rest, rest), theta, rest);
  }

  /// phi, with phi theta = H q'' + (C + B) q' + tau_g.
  [[nodiscard]] Regressor regressor(const Joints& qdot, const Joints& qddot) const noexcept {
    return regressor(qdot, qdot, qddot);
  }

  /// phi_r, with phi_r theta = H q_r'' + (C + B) q_r' + tau_g: the power of each link's wrench as joint i alone moves.
  [[nodiscard]] Regressor regressor(const Joints& qdot, const Joints& qdot_r, const Joints& qddot_r) const noexcept {
    const Fields motion = fields(-fixed_.gravity, qdot, qdot_r, qddot_r);
    std::array<Twist<Scalar>, static_cast<std::size_t>(N)> twists;  // of link k, as joint i alone moves at unit rate
    Regressor phi = Regressor::Zero();
    for (int k = 0; k < N; ++k) {
      twists[index(k)] = Twist<Scalar>{Vector::Zero(), Vector::Zero()};
      for (int i = 0; i <= k; ++i) {
        Twist<Scalar>& twist = twists[index(i)];
        if (i < k) twist = carried_up(k, twist);
        if (i == k) add_joint(k, Scalar(1), twist);
        const BodyParameters<Scalar> power = motion[index(k)].power(twist);
        for (int parameter = 0; parameter < 10; ++parameter) phi(i, 10 * k + parameter) = power[parameter];
      }
      phi(k, 10 * N + k) = qdot_r[k];
    }
    return phi;
  }

  /// phi_r theta, N m, without forming phi_r: Newton's and Euler's equations from link to link and back.
  [[nodiscard]] Joints torque(const Parameters& theta, const Joints& qdot, const Joints& qdot_r,
                              const Joints& qddot_r) const noexcept {
    return effort(fields(-fixed_.gravity, qdot, qdot_r, qddot_r), theta, qdot_r);
  }

  /// phi_r' delta of the adaptation law (4.8), without forming phi_r: the power of each link's wrench as the joints
  /// move at the rates delta, rad/s.
  [[nodiscard]] Parameters adaptation_direction(const Joints& qdot, const Joints& qdot_r, const Joints& qddot_r,
                                                const Joints& delta) const noexcept {
    const Fields motion = fields(-fixed_.gravity, qdot, qdot_r, qddot_r);
    Twist<Scalar> twist{Vector::Zero(), Vector::Zero()};
    Parameters direction;
    for (int k = 0; k < N; ++k) {
      twist = carried_up(k, twist);
      add_joint(k, delta[k], twist);
      link(direction, k) = motion[index(k)].power(twist);
    }
    for (int k = 0; k < N; ++k) direction[10 * N + k] = qdot_r[k] * delta[k];
    return direction;
  }

 private:
  using Fields = std::array<AccelerationField<Scalar>, static_cast<std::size_t>(N)>;

  // Of a joint, in the base frame: its direction, and the origin of the frame on it, m.
  struct Axis {
    Vector z, o;
  };
  struct Axes {
    std::array<Axis, static_cast<std::size_t>(N)> of;
    Vector x;  // tip, m
  };

  [[nodiscard]] static constexpr std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
  [[nodiscard]] const RigidTransform<Scalar>& frame(int i) const noexcept { return frames_[index(i)]; }
  [[nodiscard]] const Scalar& turns(int i) const noexcept { return fixed_.turns[i]; }
  [[nodiscard]] Scalar slides(int i) const noexcept { return 1 - fixed_.turns[i]; }
  // Views whose types do not depend on N: they spare compile time.
  [[nodiscard]] static auto link(const Parameters& theta, int i) noexcept {
    return Eigen::Map<const BodyParameters<Scalar>>(theta.data() + 10 * i);
  }
  [[nodiscard]] static auto link(Parameters& theta, int i) noexcept {
    return Eigen::Map<BodyParameters<Scalar>>(theta.data() + 10 * i);
  }
  [[nodiscard]] static auto column(Jacobian& J, int i) noexcept { return Eigen::Map<Vector>(J.data() + 3 * i); }

  [[nodiscard]] Axes axes_in_base() const noexcept {
    Axes axes;
    Rotation R = Rotation::Identity();
    axes.x = Vector::Zero();
    for (int i = 0; i < N; ++i) {
      axes.x += R * frame(i).p;
      R = R * frame(i).R;
      axes.of[index(i)] = {R.col(2), axes.x};
    }
    axes.x += R * fixed_.tip;
    return axes;
  }

  // From frame i - 1 into frame i, of which it is the twist without joint i.
  [[nodiscard]] Twist<Scalar> carried_up(int i, const Twist<Scalar>& twist) const noexcept {
    const auto& [R, p] = frame(i);
    return {R.transpose() * twist.omega, R.transpose() * (twist.v + twist.omega.cross(p))};
  }
  void add_joint(int i, const Scalar& rate, Twist<Scalar>& twist) const noexcept {
    twist.omega[2] += turns(i) * rate;
    twist.v[2] += slides(i) * rate;
  }

  // From frame i into frame i - 1.
  [[nodiscard]] Wrench<Scalar> carried_down(int i, const Wrench<Scalar>& wrench) const noexcept {
    const auto& [R, p] = frame(i);
    const Vector force = R * wrench.force;
    return {R * wrench.moment + p.cross(force), force};
  }
  // What the motor of joint i has of a wrench in frame i, N m or N.
  [[nodiscard]] Scalar joint_effort(int i, const Wrench<Scalar>& wrench) const noexcept {
    return turns(i) * wrench.moment[2] + slides(i) * wrench.force[2];
  }

  // A_r and W_r of every link, from those of the base. Where a joint turns at q', its z is at rest in both links; where
  // it slides, the link's origin moves by Coriolis' law, one half of it with q_r'.
  [[nodiscard]] Fields fields(const Vector& base, const Joints& qdot, const Joints& qdot_r,
                              const Joints& qddot_r) const noexcept {
    const Vector z = Vector::UnitZ();
    Vector omega = Vector::Zero(), omega_r = Vector::Zero(), alpha_r = Vector::Zero();
    Fields fields;
    for (int i = 0; i < N; ++i) {
      const auto& [R, p] = frame(i);
      Vector A_r = R.transpose() * (i == 0 ? base : fields[index(i - 1)].at(p));
      omega = R.transpose() * omega;
      omega_r = R.transpose() * omega_r;
      A_r += slides(i) * (qddot_r[i] * z + (omega * qdot_r[i] + omega_r * qdot[i]).cross(z));
      alpha_r = R.transpose() * alpha_r + turns(i) * (qddot_r[i] * z + qdot_r[i] * omega.cross(z));
      omega += turns(i) * qdot[i] * z;
      omega_r += turns(i) * qdot_r[i] * z;
      fields[index(i)] = AccelerationField<Scalar>::of(A_r, alpha_r, omega_r, omega);
    }
    return fields;
  }

  // Torques of the joints under the links' inertial forces and the friction at the rates qdot_r.
  [[nodiscard]] Joints effort(const Fields& motion, const Parameters& theta, const Joints& qdot_r) const noexcept {
    Joints tau;
    Wrench<Scalar> carried{Vector::Zero(), Vector::Zero()};
    for (int i = N; i-- > 0;) {
      const Wrench<Scalar> own = motion[index(i)].wrench(link(theta, i));
      carried = {carried.moment + own.moment, carried.force + own.force};
      tau[i] = joint_effort(i, carried) + theta[10 * N + i] * qdot_r[i];
      if (i > 0) carried = carried_down(i, carried);
    }
    return tau;
  }

  Fixed fixed_;
  Frames frames_;
};

}  // namespace limpid
