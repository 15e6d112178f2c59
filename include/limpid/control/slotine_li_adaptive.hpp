// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/tracking_law.hpp>
#include <limpid/core/any_lane.hpp>
#include <limpid/core/flat.hpp>
#include <limpid/core/lanes.hpp>
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
        Gamma_{to_packed_lanes(settings.Gamma)},
        lower_{to_packed_lanes(settings.lower)},
        upper_{to_packed_lanes(settings.upper)},
        longest_step_{settings.longest_step},
        theta_hat_{to_packed_lanes(settings.theta0)} {
    law_.check("SlotineLiAdaptive");
    const auto &Gamma = settings.Gamma, &theta0 = settings.theta0, &lower = settings.lower, &upper = settings.upper;
    expect(is_finite(Gamma) && (Gamma.array() >= Scalar(0)).all(), "SlotineLiAdaptive: Gamma", "finite and >= 0",
           Gamma);
    expect(is_finite(theta0), "SlotineLiAdaptive: theta0", "finite", theta0);
    expect((lower.array() <= theta0.array()).all(), "SlotineLiAdaptive: lower", "<= theta0", lower);
    expect((upper.array() >= theta0.array()).all(), "SlotineLiAdaptive: upper", ">= theta0", upper);
    expect(longest_step_ > Duration::zero(), "SlotineLiAdaptive: longest_step", "> 0 s", longest_step_);
  }

  /// Adapts up to `now`, then gives the torque that moves the joints from `is` toward `wanted` under the operator's
  /// force F_h, N, base frame. The first call only starts the clock of the adaptation.
  /// @param applied  torque that the device had since the last call, N m; unless it is the torque that the last call
  ///                 gave, to the last bit, nothing is adapted for that time
  [[nodiscard]] Output update(Time now, const JointState<RobotTraits<R>::joints, Scalar>& is,
                              const DesiredJoints<RobotTraits<R>::joints, Scalar>& wanted, const Force& F_h,
                              const Joints& applied) noexcept {
    return flat<Scalar>([&]() noexcept {
      return adapted(now, is, wanted, F_h, {is_finite(applied), (applied.array() == tau_.array()).all()});
    });
  }

  /// The same where another component, such as a FrictionCompensator, adds its torque to what this one gives.
  /// @param added  what was added to the last call's torque, N m; adapted is where `applied` is the sum, to the last
  /// bit
  [[nodiscard]] Output update(Time now, const JointState<RobotTraits<R>::joints, Scalar>& is,
                              const DesiredJoints<RobotTraits<R>::joints, Scalar>& wanted, const Force& F_h,
                              const Joints& applied, const Joints& added) noexcept {
    return flat<Scalar>([&]() noexcept {
      const Joints asked = tau_ + added;
      return adapted(now, is, wanted, F_h,
                     {is_finite(applied) && is_finite(added), (applied.array() == asked.array()).all()});
    });
  }

  /// The same for a device that always has the torque that it is asked for.
  [[nodiscard]] Output update(Time now, const JointState<RobotTraits<R>::joints, Scalar>& is,
                              const DesiredJoints<RobotTraits<R>::joints, Scalar>& wanted, const Force& F_h) noexcept {
    return flat<Scalar>([&]() noexcept { return adapted(now, is, wanted, F_h, {true, true}); });
  }

  /// Nothing is adapted from the last call to the next one: for an error that does not speak of the parameters, such as
  /// that of a joint that sticks.
  void skip_adaptation() noexcept { obeyed_ = false; }

  [[nodiscard]] Parameters theta_hat() const noexcept { return of(theta_hat_); }

 private:
  using Array = PackedLanes<RobotTraits<R>::parameters, Scalar>;

  // What is said of the torque that the device had.
  struct Applied {
    bool finite, obeyed;
  };

  [[nodiscard]] Output adapted(Time now, const JointState<RobotTraits<R>::joints, Scalar>& is,
                               const DesiredJoints<RobotTraits<R>::joints, Scalar>& wanted, const Force& F_h,
                               const Applied& applied) noexcept {
    if (started_ && now <= last_) return {tau_, Status::clock_backwards};
    obeyed_ = obeyed_ && applied.obeyed;
    const auto pose = RobotTraits<R>::at(robot_, is.q);
    const auto reference = law_.reference(is, wanted);
    const Array direction =
        to_packed_lanes(pose.adaptation_direction(is.qdot, reference.qdot, reference.qddot, reference.delta));
    const Scalar power = reference.delta.dot(law_.Kd.cwiseProduct(reference.delta));
    const Scalar half_step = adapts(now) ? in_seconds<Scalar>(elapsed(now, last_)) / Scalar(2) : Scalar(0);
    const Array twice_mean = direction + direction_, slope = Gamma_ * twice_mean;
    // both per half_step; an overflow is no step either
    const bool sound = half_step * (twice_mean * slope).sum() <= Scalar(2) * (power + power_) && is_finite(power);
    const Array step = half_step * slope, moved = theta_hat_ - (sound ? step : Array(Array::Zero()));
    const Array kept = moved.max(lower_).min(upper_);
    const Joints tau = law_.torque(pose, of(kept), is.qdot, reference, F_h);
    // a non-finite input reaches tau or the step, whatever the gains: RobotPose's law
    if (!is_finite(tau) || !are_finite(step) || !applied.finite) return {tau_, Status::not_finite};
    started_ = true;
    obeyed_ = true;
    last_ = now;
    direction_ = direction;
    power_ = power;
    theta_hat_ = kept;
    tau_ = tau;
    return {tau_, when(!sound || differ(moved, kept), Status::at_bound)};
  }

  // Of finite entries.
  static bool differ(const Array& a, const Array& b) noexcept {
    const Array distance = (a - b).abs();
    if constexpr (detail::in_packets<Array>) {
      return !detail::all_at_most(distance, Scalar(0));
    } else {
      return distance.sum() > Scalar(0);
    }
  }

  static Parameters of(const Array& theta) noexcept { return theta.template head<RobotTraits<R>::parameters>(); }

  [[nodiscard]] bool adapts(Time now) const noexcept {
    return started_ && obeyed_ && elapsed(now, last_) <= longest_step_;
  }

  R robot_;
  TrackingLaw<R> law_;
  Array Gamma_, lower_, upper_;
  Duration longest_step_;
  Array theta_hat_;
  Array direction_ = Array::Zero();  // phi_r' delta at the last call
  Scalar power_{0};                  // delta' K_d delta then, W
  Joints tau_ = Joints::Zero();      // last good torque
  Time last_{};
  bool started_ = false;
  bool obeyed_ = true;  // whether the device had tau_ since then, as far as is known
};

}  // namespace limpid
