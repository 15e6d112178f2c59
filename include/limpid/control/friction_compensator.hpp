// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/friction_identifier.hpp>
#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/real.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/robot/joint_state.hpp>

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace limpid {

/// Takes a share of each joint's friction off, fed forward from the motion that is wanted:
///
///     tau = share (f_c^ z(q_e) + f_v^ q_e'),      dz = (dq_e - |dq_e| z)/z_s      |tau| <= `largest`
///
/// z is Dahl's smooth sign of the last movement: after a reversal it turns over the distance z_s, and where q_e rests
/// it rests, so that a joint is held as it was pushed last. Over a straight piece it is exact at any spacing of the
/// ticks. f_c^ and f_v^ are identified on line; see FrictionIdentifier.
///
/// What theory covers. With the compensator, (4.11) of SlotineLiAdaptive and V of (4.10) becomes
///
///     V' = -delta' K_d delta + delta' (tau - tau_friction) <= -lambda_min(K_d) |delta|^2 + |delta| epsilon
///
/// so that V falls wherever |delta| > epsilon/lambda_min(K_d), epsilon the norm of what the compensation misses of the
/// friction: at most `largest` + f_c a joint, when both point against each other; |f_c - share f_c^| where the joint
/// slides as it is wanted to, which is less than the f_c without compensation as long as f_c^ < 2 f_c/share. So delta
/// ends in a ball, not at zero, given bounds on theta_hat (`lower`, `upper`); and that for any z and any f_c^ in its
/// range, identified right or wrong. That is the continuous law with exact rates: ticks, encoder steps and an
/// observer's error are left to simulation (test/control/friction_press_test.cpp).
///
/// For a given q_e it closes no loop but that of f_c^, which only motion beyond an encoder step changes: under a q_e at
/// rest the torque is constant, and where f_c^ <= f_c less than the friction that holds the joint. So it drives no
/// limit cycle by itself; a q_e that a hand and a tissue close with the arm is not covered.
/// @tparam Joints  number of joints
/// @realtime       no allocation, no throw; an exponential a joint, 4 more and some 40 flops in `identify`
template <int Joints = 3, Real Scalar = double>
class FrictionCompensator {
 public:
  using Vector = Eigen::Array<Scalar, Joints, 1>;
  using Torque = Eigen::Matrix<Scalar, Joints, 1>;

  struct Settings {
    FrictionIdentifierSettings<Joints, Scalar> identifier{};
    /// z_s, rad of the wanted motion after a reversal, > 0. Not below an encoder step, or noise of q_e within it
    /// reverses the torque.
    Vector presliding = Vector::Constant(Scalar(1) / Scalar(1000));
    Scalar share = Scalar(9) / Scalar(10);  ///< of what is identified, in [0, 1): never all of it
  };

  struct Output {
    Torque tau;     ///< to add to the controller's, N m; always finite
    Status status;  ///< `not_finite`: the call changed nothing, the last torque
  };

  /// @throws std::invalid_argument  where a setting cannot serve
  explicit FrictionCompensator(const Settings& settings)
      : identifier_{settings.identifier},
        largest_{settings.identifier.largest},
        presliding_{settings.presliding},
        share_{settings.share} {
    expect(is_finite(presliding_) && (presliding_ > Scalar(0)).all(), "FrictionCompensator: presliding",
           "finite and > 0", presliding_);
    expect(is_finite(share_) && share_ >= Scalar(0) && share_ < Scalar(1), "FrictionCompensator: share", "of [0, 1)",
           share_);
  }

  /// Learns the friction from the motion and from the torque that braked it, N m, positive against the joint:
  /// VelocityObserver's state and minus its disturbance.
  [[nodiscard]] Status identify(Time now, const JointState<Joints, Scalar>& is, const Torque& friction) noexcept {
    return identifier_.update(now, is, friction);
  }

  /// The torque that helps the joints to move as wanted. The first call takes q_e for where they rest.
  [[nodiscard]] Output update(const DesiredJoints<Joints, Scalar>& wanted) noexcept {
    const Vector q = wanted.q.array(), qdot = wanted.qdot.array();
    if (!is_finite(q) || !is_finite(qdot)) return {tau_, Status::not_finite};
    Vector z = z_;
    if (started_) {
      const Vector path = (q - q_) / presliding_;
      if (!is_finite(path)) return {tau_, Status::not_finite};
      for (int i = 0; i < Joints; ++i) z[i] = turned(z_[i], path[i]);
    }
    const auto& found = identifier_.friction();
    const Vector tau = (share_ * (found.coulomb * z + found.viscous * qdot)).min(largest_).max(-largest_);
    started_ = true;
    q_ = q;
    z_ = z;
    tau_ = tau.matrix();
    return {tau_, Status::ok};
  }

  /// f_c^ and f_v^.
  [[nodiscard]] const JointFriction<Joints, Scalar>& friction() const noexcept { return identifier_.friction(); }

 private:
  FrictionIdentifier<Joints, Scalar> identifier_;
  Vector largest_, presliding_;
  Scalar share_;
  bool started_ = false;
  Vector q_ = Vector::Zero();    // q_e of the last call
  Vector z_ = Vector::Zero();    // in [-1, 1]
  Torque tau_ = Torque::Zero();  // last good one
};

}  // namespace limpid
