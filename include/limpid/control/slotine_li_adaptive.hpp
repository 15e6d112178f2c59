// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/tracking_law.hpp>
#include <limpid/core/flat.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>

#include <chrono>
#include <limits>

namespace limpid {

/// Tracking controller that adapts the robot's parameters as it goes, after Slotine and Li. Eqs. (4.7), (4.8).
///
///     tau = phi_r theta_hat - K_d delta - J' F_h        theta_hat' = -Gamma phi_r' delta
///
/// Between ticks the direction d = phi_r' delta is taken to be linear in time (trapezoidal rule); it does not depend on
/// theta_hat, so that the rule is explicit. With bounds, theta_hat is projected on their box after each step: Gamma is
/// diagonal, so that clamping each entry is the projection that (4.10) asks for and its V does not grow by it.
///
/// A step Delta theta over h seconds adds Delta theta' Gamma^-1 Delta theta / 2 to V that the continuous law does not.
/// Where that is more than the h delta' K_d delta that the controller takes out of V meanwhile, (4.11) speaks no longer
/// for the tick, and the step is left out whole: a single reading of an impossible rate leaves theta_hat as it was.
///
/// (4.8) rests on the arm having the torque of (4.7). Where a limiter gave it another one, adaptation would blame the
/// parameters for the error and wind up: tell `update` what was applied, and nothing is adapted over such an interval.
/// @tparam R  a Robot of n joints and p parameters
/// @realtime  update: no allocation, no throw
template <Robot R>
class SlotineLiAdaptive {
 public:
  using Scalar = RobotScalar<R>;
  using Joints = JointVector<R>;
  using Parameters = RobotParameters<R>;
  using Force = typename TrackingLaw<R>::Force;

  struct Settings {
    R robot{};
    Joints Lambda = unset<Joints>();  ///< diagonal of Lambda, 1/s; > 0
    Joints Kd = unset<Joints>();      ///< diagonal of K_d, N m s/rad; > 0
    Parameters Gamma =
        unset<Parameters>();  ///< diagonal of Gamma, in the units of theta^2 per (N m rad); >= 0, 0 holds an entry
    Parameters theta0 = unset<Parameters>();  ///< theta_hat at the start, within the bounds
    Parameters lower = Parameters::Constant(-std::numeric_limits<Scalar>::infinity());  ///< of theta_hat
    Parameters upper = Parameters::Constant(std::numeric_limits<Scalar>::infinity());   ///< of theta_hat
    Duration longest_step = std::chrono::milliseconds(100);  ///< after a longer pause nothing is adapted for it
  };

  struct Output {
    Joints tau;  ///< N m; always finite
    /// not_finite, clock_backwards: last good torque, theta_hat untouched; at_bound: an entry was clamped, or a step
    /// left out
    Status status;
  };

  /// @throws std::invalid_argument  where a gain, a start or a bound cannot serve
  explicit SlotineLiAdaptive(const Settings& settings)
      : robot_{settings.robot},
        law_{settings.Lambda, settings.Kd},
        Gamma_{settings.Gamma},
        lower_{settings.lower},
        upper_{settings.upper},
        longest_step_{settings.longest_step},
        theta_hat_{settings.theta0} {
    law_.check("SlotineLiAdaptive");
    expect(is_finite(Gamma_) && (Gamma_.array() >= Scalar(0)).all(), "SlotineLiAdaptive: Gamma", "finite and >= 0",
           Gamma_);
    expect(is_finite(theta_hat_), "SlotineLiAdaptive: theta0", "finite", theta_hat_);
    expect((lower_.array() <= theta_hat_.array()).all(), "SlotineLiAdaptive: lower", "<= theta0", lower_);
    expect((upper_.array() >= theta_hat_.array()).all(), "SlotineLiAdaptive: upper", ">= theta0", upper_);
    expect(longest_step_ > Duration::zero(), "SlotineLiAdaptive: longest_step", "> 0 s", longest_step_);
  }

  /// Adapts up to `now`, then gives the torque that moves the joints from `is` toward `wanted` under the operator's
  /// force F_h, N, base frame. The first call only starts the clock of the adaptation.
  /// @param applied  torque that the device had since the last call, N m; unless it is the torque that the last call
  ///                 gave, to the last bit, nothing is adapted for that time
  [[nodiscard]] Output update(Time now, const JointState<RobotTraits<R>::joints, Scalar>& is,
                              const DesiredJoints<RobotTraits<R>::joints, Scalar>& wanted, const Force& F_h,
                              const Joints& applied) noexcept {
    return flat<Scalar>([&]() noexcept { return adapted(now, is, wanted, F_h, applied); });
  }

  /// The same for a device that always has the torque that it is asked for.
  [[nodiscard]] Output update(Time now, const JointState<RobotTraits<R>::joints, Scalar>& is,
                              const DesiredJoints<RobotTraits<R>::joints, Scalar>& wanted, const Force& F_h) noexcept {
    return update(now, is, wanted, F_h, Joints(tau_));
  }

  [[nodiscard]] const Parameters& theta_hat() const noexcept { return theta_hat_; }

 private:
  [[nodiscard]] Output adapted(Time now, const JointState<RobotTraits<R>::joints, Scalar>& is,
                               const DesiredJoints<RobotTraits<R>::joints, Scalar>& wanted, const Force& F_h,
                               const Joints& applied) noexcept {
    if (started_ && now <= last_) return {tau_, Status::clock_backwards};
    obeyed_ = obeyed_ && (applied.array() == tau_.array()).all();
    const auto pose = RobotTraits<R>::at(robot_, is.q);
    const auto reference = law_.reference(is, wanted);
    const Parameters direction = pose.adaptation_direction(is.qdot, reference.qdot, reference.qddot, reference.delta);
    const Scalar power = reference.delta.dot(law_.Kd.cwiseProduct(reference.delta));
    const Scalar half_step = adapts(now) ? in_seconds<Scalar>(elapsed(now, last_)) / Scalar(2) : Scalar(0);
    const Parameters twice_mean = direction + direction_, slope = Gamma_.cwiseProduct(twice_mean);
    // both per half_step; an overflow is no step either
    const bool sound = half_step * twice_mean.dot(slope) <= Scalar(2) * (power + power_) && is_finite(power);
    const Parameters step = half_step * slope;
    const Parameters moved = sound ? Parameters(theta_hat_ - step) : theta_hat_;
    const Parameters theta_hat = moved.cwiseMax(lower_).cwiseMin(upper_);
    const Joints tau = law_.torque(pose, theta_hat, is.qdot, reference, F_h);
    // a non-finite input reaches tau or the step, whatever the gains: RobotPose's law
    if (!is_finite(tau) || !is_finite(step) || !is_finite(applied)) return {tau_, Status::not_finite};
    started_ = true;
    obeyed_ = true;
    last_ = now;
    direction_ = direction;
    power_ = power;
    theta_hat_ = theta_hat;
    tau_ = tau;
    return {tau_, when(!sound || (moved.array() != theta_hat.array()).any(), Status::at_bound)};
  }

  [[nodiscard]] bool adapts(Time now) const noexcept {
    return started_ && obeyed_ && elapsed(now, last_) <= longest_step_;
  }

  R robot_;
  TrackingLaw<R> law_;
  Parameters Gamma_, lower_, upper_;
  Duration longest_step_;
  Parameters theta_hat_;
  Parameters direction_ = Parameters::Zero();  // phi_r' delta at the last call
  Scalar power_{0};                            // delta' K_d delta then, W
  Joints tau_ = Joints::Zero();                // last good torque
  Time last_{};
  bool started_ = false;
  bool obeyed_ = true;  // whether the device had tau_ since then, as far as is known
};

}  // namespace limpid
