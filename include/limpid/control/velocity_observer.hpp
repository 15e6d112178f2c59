// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/robot/joint_state.hpp>
#include <limpid/robot/robot.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <chrono>
#include <cmath>
#include <limits>

namespace limpid {

/// Joint rates from joint angles, the dynamics (3.15) and the torques that the arm is known to have: no lag behind the
/// motion that these explain. What they do not explain is estimated with it, as an acceleration alpha:
///
///     q^' = q'^ + 3 w e        q'^' = H^-1 (tau + J' F_h - (C + B) q'^ - tau_g) + alpha^ + 3 w^2 e
///     alpha^' = w^3 e
///
/// with e = q - q^, and H, C, J and tau_g at the measured q, of a tick its middle. The errors then follow
///
///     e1' = e2 - 3 w e1        e2' = alpha~ + f(q') - f(q'^) - 3 w^2 e1        alpha~' = alpha' - w^3 e1
///
/// where f = -H^-1 (C + B) q'. Without the difference of f all three poles are -w. With it, and with a constant alpha,
/// the errors converge where f has a Lipschitz constant L < w/1.188: 1.188/w, the peak of |s (s + 3 w)/(s + w)^3|, is
/// the gain from that difference to e2 (small gain theorem; in continuous time). The Omni of Table 5.2 has L < 40/s
/// below 5 rad/s a joint. An alpha of bounded rate leaves an error of bounded size.
///
/// A tick takes the torque as held and alpha as constant, the friction of q'^ implicitly (trapezoidal rule), and
/// corrects by the gains that put all three poles at exp(-w h): for ticks of constant length; after others they are
/// those of each tick. Readings rounded to steps of d leave a noise of some .4 d sqrt(h) w^1.5 in q'^, as long as their
/// errors are independent.
///
/// The disturbance H alpha^ is what friction, a wrong theta and forgotten forces come to, some 3/w late. Of a realistic
/// Omni that swings at .7 rad/s (4e-4 rad, static friction that is not in theta) w = 100 leaves an error of .037 rad/s,
/// w = 150 of .023; AdaptiveWindowVelocity .036, the filter (5.3) .12.
/// @tparam R  a Robot of n joints
/// @realtime  update: no allocation, no throw; H, C and J once and an inverse of n x n
template <Robot R>
class VelocityObserver {
 public:
  using Scalar = RobotScalar<R>;
  static constexpr int joints = RobotTraits<R>::joints;
  using Joints = JointVector<R>;
  using Parameters = RobotParameters<R>;
  using Force = Eigen::Matrix<Scalar, 3, 1>;
  using State = JointState<joints, Scalar>;

  struct Settings {
    R robot{};
    Parameters theta =
        Parameters::Constant(std::numeric_limits<Scalar>::quiet_NaN());  ///< the robot's parameters, with H > 0
    Scalar bandwidth = Scalar(100);                                      ///< w, rad/s, > 0
    Duration longest_step = std::chrono::milliseconds(20);  ///< after a longer pause it starts again, at rest
  };

  struct Output {
    State state;         ///< q^, rad, and q'^, rad/s; always finite
    Joints disturbance;  ///< H alpha^, N m, positive with the joint; always finite
    Status status;       ///< `not_finite` or `clock_backwards`: the call changed nothing
  };

  /// @throws std::invalid_argument  where a setting cannot serve
  explicit VelocityObserver(const Settings& settings)
      : robot_{settings.robot},
        theta_{settings.theta},
        bandwidth_{settings.bandwidth},
        longest_step_{settings.longest_step} {
    expect(is_finite(theta_), "VelocityObserver: theta", "finite", theta_);
    expect(is_finite(bandwidth_) && bandwidth_ > Scalar(0), "VelocityObserver: bandwidth", "finite and > 0",
           bandwidth_);
    expect(longest_step_ > Duration::zero(), "VelocityObserver: longest_step", "> 0 s", longest_step_);
  }

  /// Takes the angles `q` that were measured at `now`. The first call starts it there, at rest.
  /// @param applied  torque that the device had since the last call, N m, behind limiters and saturation
  /// @param F_h      operator's force on the tip at `now`, N, base frame; linear since the last call
  [[nodiscard]] Output update(Time now, const Joints& q, const Joints& applied, const Force& F_h) noexcept {
    if (started_ && now <= now_) return said(Status::clock_backwards);
    if (!is_finite(q) || !is_finite(applied) || !is_finite(F_h)) return said(Status::not_finite);
    if (!started_ || elapsed(now, now_) > longest_step_) {
      state_ = {q, Joints::Zero()};
      alpha_.setZero();
      disturbance_.setZero();
    } else {
      if (elapsed(now, now_) != step_) set_step(elapsed(now, now_));
      if (!advance(q, applied, F_h)) return said(Status::not_finite);
    }
    started_ = true;
    now_ = now;
    q_ = q;
    F_h_ = F_h;
    return said(Status::ok);
  }

 private:
  // False, with nothing changed, where the motion leaves the scalar's range or H is singular.
  [[nodiscard]] bool advance(const Joints& q, const Joints& applied, const Force& F_h) noexcept {
    const auto pose = RobotTraits<R>::at(robot_, Joints(q_ + (q - q_) / Scalar(2)));
    const JointMatrix<R> H = pose.H(theta_), D = pose.C(theta_, state_.qdot) + pose.B(theta_);
    const Force mean = F_h_ + (F_h - F_h_) / Scalar(2);
    const Joints known = applied + pose.jacobian().transpose() * mean - pose.tau_g(theta_);
    const JointMatrix<R> implicit = H + (h_ / Scalar(2)) * D;
    const Joints rise = h_ * (implicit.inverse() * (known + H * alpha_ - D * state_.qdot));
    const Joints ahead = state_.q + h_ * (state_.qdot + rise / Scalar(2)), e = q - ahead;
    const State state{ahead + on_q_ * e, state_.qdot + rise + on_qdot_ * e};
    const Joints alpha = alpha_ + on_alpha_ * e, disturbance = H * alpha;
    if (!is_finite(state) || !is_finite(disturbance)) return false;
    state_ = state;
    alpha_ = alpha;
    disturbance_ = disturbance;
    return true;
  }

  // Gains for a triple pole at z = exp(-w h).
  void set_step(Duration step) noexcept {
    using std::expm1;
    step_ = step;
    h_ = in_seconds<Scalar>(step);
    const Scalar rest = -expm1(-bandwidth_ * h_), z = Scalar(1) - rest;  // 1 - z
    on_q_ = rest * (Scalar(1) + z + z * z);                              // 1 - z^3
    on_qdot_ = Scalar(3) * rest * rest * (Scalar(1) + z) / (Scalar(2) * h_);
    on_alpha_ = rest * rest * rest / (h_ * h_);
  }

  [[nodiscard]] Output said(Status status) const noexcept { return {state_, disturbance_, status}; }

  R robot_;
  Parameters theta_;
  Scalar bandwidth_;
  Duration longest_step_;
  Duration step_{};  // for which these are, with h in seconds:
  Scalar h_{0}, on_q_{0}, on_qdot_{0}, on_alpha_{0};
  bool started_ = false;
  Time now_{};                 // the last tick,
  Joints q_ = Joints::Zero();  // what was measured at it
  Force F_h_ = Force::Zero();  // and the operator's force
  State state_{};              // q^, q'^
  Joints alpha_ = Joints::Zero(), disturbance_ = Joints::Zero();
};

}  // namespace limpid
