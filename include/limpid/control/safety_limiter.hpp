// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/fault_reason.hpp>
#include <limpid/control/omni_safety.hpp>
#include <limpid/control/safe_torque.hpp>
#include <limpid/control/safety_traits.hpp>
#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/robot/joint_state.hpp>
#include <limpid/robot/robot.hpp>

#include <algorithm>
#include <chrono>
#include <optional>

namespace limpid {

/// The last block before the device, and the only maker of SafeTorque. Sections 5.2.3 and 5.2.4.
///
///     |tau| <= tau_max / SF        no torque toward a joint limit, (5.4) or an edge of the workspace that is near
///     |tau - tau_last| <= slew dt  for each joint; a torque that a rule forbids goes at once
///
/// A fault gives zero torque in the same call, whatever the slew rate, and from then on until `reset`: a non-finite
/// input, a clock that does not advance or leaps, a joint far beyond its limits, or an upstream status that counts as a
/// fault. The first call gives zero torque and starts the clock.
///
/// The torques that the rules allow form a convex set with zero in it. The last torque is brought into the set of this
/// pose, then moved straight toward the wanted torque, brought into it likewise, as far as the slew rate lets it: so no
/// rule is broken on the way. What a rule takes away it takes at once; what it would add comes at the slew rate.
///
/// Over a band before its margin a rule sets in gradually, so that the set, and what passes of a steady wanted torque,
/// is continuous in q: by default an Omni's joint torque changes by less than 20 N m per rad of motion, whatever the
/// wanted torque, and by 1/joint_band of its limit per rad where no edge of the workspace is near.
/// @tparam R  a Robot; limits of its own that join several joints come through SafetyTraits
/// @realtime  limit: no allocation, no throw, bounded work
template <Robot R>
class SafetyLimiter {
 public:
  static constexpr int joints = RobotTraits<R>::joints;
  using Scalar = RobotScalar<R>;
  using Joints = JointVector<R>;
  using Torque = SafeTorque<joints, Scalar>;

  struct Settings {
    R robot{};
    Scalar safety_factor = Scalar(13) / Scalar(10);     ///< SF, >= 1
    std::optional<Joints> torque_limit{};               ///< tau_max, N m, > 0; else the robot's
    std::optional<Joints> slew{};                       ///< N m/s, > 0; else from zero to tau_max / SF in 10 ms
    Scalar joint_margin = Scalar(1) / Scalar(10);       ///< from a joint limit or (5.4), rad, >= 0
    Scalar joint_band = Scalar(5) / Scalar(100);        ///< before that margin, rad, >= 0; 0: a step at the margin
    Scalar workspace_margin = Scalar(1) / Scalar(100);  ///< from an edge of the workspace, m, >= 0
    Scalar workspace_band = Scalar(5) / Scalar(1000);   ///< before that margin, m, >= 0; 0: a step at the margin
    bool workspace = true;  ///< whether the workspace is watched; only a robot with SafetyTraits of its own has one
    Scalar joint_overshoot = Scalar(1) / Scalar(10);       ///< beyond a joint limit before it is a fault, rad, >= 0
    Duration longest_gap = std::chrono::milliseconds(20);  ///< between calls before it is a fault, > 0
    /// Bits of the upstream status that are a fault.
    Status upstream_faults = Status::not_finite | Status::fault | Status::disconnected | Status::stale;
  };

  struct Result {
    Torque torque;
    Status status;  ///< fault; or limited, joint_limit, workspace_limit where a rule took something away
  };

  /// @throws std::invalid_argument  where a setting cannot serve
  explicit SafetyLimiter(const Settings& settings) : settings_{settings} {
    const auto limits = RobotTraits<R>::limits(settings.robot);
    const Joints most = settings.torque_limit.value_or(limits.torque);
    expect(is_finite(settings.safety_factor) && settings.safety_factor >= Scalar(1), "SafetyLimiter: safety_factor",
           "finite and >= 1", settings.safety_factor);
    expect(is_finite(Joints(most * Scalar(4))) && (most.array() > Scalar(0)).all(), "SafetyLimiter: torque_limit",
           "finite and > 0", most);
    allowed_ = most / settings.safety_factor;
    expect((allowed_.array() > Scalar(0)).all(), "SafetyLimiter: safety_factor",
           "small enough for torque_limit over it", settings.safety_factor);
    slew_ = settings.slew.value_or(Joints(allowed_ * Scalar(100)));
    if (!settings.slew) {
      expect(is_finite(Joints(slew_ * Scalar(4))), "SafetyLimiter: torque_limit", "small enough for its slew in 10 ms",
             most);
    }
    lower_ = limits.lower;
    upper_ = limits.upper;
    expect(is_finite(Joints(slew_ * Scalar(4))) && (slew_.array() > Scalar(0)).all(), "SafetyLimiter: slew",
           "finite and > 0", slew_);
    check_distance(settings.joint_margin, "SafetyLimiter: joint_margin");
    check_distance(settings.joint_band, "SafetyLimiter: joint_band");
    check_distance(settings.workspace_band, "SafetyLimiter: workspace_band");
    check_distance(settings.workspace_margin, "SafetyLimiter: workspace_margin");
    check_distance(settings.joint_overshoot, "SafetyLimiter: joint_overshoot");
    expect(settings.longest_gap > Duration::zero(), "SafetyLimiter: longest_gap", "> 0 s", settings.longest_gap);
  }

  /// What of the `wanted` torque, N m, the device may have at `now`.
  /// @param is        measured joints
  /// @param upstream  joined status of the blocks before this one
  [[nodiscard]] Result limit(Time now, const JointState<joints, Scalar>& is, const Joints& wanted,
                             Status upstream = Status::ok) noexcept {
    if (reason_ == FaultReason::none) reason_ = find_fault(now, is, wanted, upstream);
    if (reason_ != FaultReason::none) {
      torque_.setZero();
      return {Torque{}, Status::fault};
    }
    const Scalar dt = started_ ? in_seconds<Scalar>(elapsed(now, last_)) : Scalar(0);
    started_ = true;
    resumed_ = false;
    last_ = now;
    const auto allowed = allowed_at(is.q);
    const Joints from = allowed.fit(torque_).torque;
    const auto to = allowed.fit(wanted);
    const Joints slewed = slew_ * dt;
    const Scalar kept = part_kept(from, slewed);
    const Joints start = kept * from, step = to.torque - start;
    const Scalar part = part_of(step, (slewed - added(start)).cwiseMax(Scalar(0)));
    if (part < Scalar(1)) {
      torque_ = allowed.fit(start + part * step).torque;  // takes no more than a rounding away
      return {Torque{torque_}, to.status | Status::limited};
    }
    torque_ = to.torque;
    return {Torque{torque_}, to.status};
  }

  /// Ends a fault, deliberately; without one it changes nothing. Torque starts again from zero, and the clock at `now`.
  /// The arm has moved on by itself meanwhile: call it only once the references of the controller before this block
  /// start again where the arm is, at rest; else the torque rises at the slew rate toward whatever the error has
  /// become.
  void reset(Time now) noexcept {
    if (reason_ == FaultReason::none) return;
    reason_ = FaultReason::none;
    torque_.setZero();
    last_ = now;
    started_ = resumed_ = true;
  }

  /// Why there is no torque; `none` in normal work.
  [[nodiscard]] FaultReason reason() const noexcept { return reason_; }

 private:
  using Allowed = TorqueSet<joints, Scalar, SafetyTraits<R>::half_spaces>;

  static void check_distance(const Scalar& distance, const char* name) {
    expect(is_finite(distance) && distance >= Scalar(0), name, "finite and >= 0", distance);
  }

  [[nodiscard]] FaultReason find_fault(Time now, const JointState<joints, Scalar>& is, const Joints& wanted,
                                       Status upstream) const noexcept {
    if (!is_finite(is)) return FaultReason::state_not_finite;
    if (!is_finite(wanted)) return FaultReason::torque_not_finite;
    if (started_ && (now < last_ || (now == last_ && !resumed_))) return FaultReason::clock_backwards;
    if (started_ && elapsed(now, last_) > settings_.longest_gap) return FaultReason::gap_too_long;
    const auto overshoot = (is.q - upper_).cwiseMax(lower_ - is.q);  // of a limit that is infinite: -infinity
    if ((overshoot.array() > settings_.joint_overshoot).any()) return FaultReason::joint_out_of_range;
    if (has(upstream & settings_.upstream_faults, Status::disconnected)) return FaultReason::disconnected;
    if (has(upstream, settings_.upstream_faults)) return FaultReason::upstream;
    return FaultReason::none;
  }

  [[nodiscard]] Allowed allowed_at(const Joints& q) const noexcept {
    Allowed allowed(allowed_);
    const SafetyMargin<Scalar> near_joint{settings_.joint_margin, settings_.joint_band};
    for (Eigen::Index i = 0; i < joints; ++i) {
      allowed.narrow_positive(i, near_joint.share(upper_[i] - q[i]), Status::joint_limit);
      allowed.narrow_negative(i, near_joint.share(q[i] - lower_[i]), Status::joint_limit);
    }
    SafetyTraits<R>::limit_joints(settings_.robot, q, near_joint, allowed);
    if (settings_.workspace) {
      SafetyTraits<R>::limit_workspace(settings_.robot, q, {settings_.workspace_margin, settings_.workspace_band},
                                       allowed);
    }
    return allowed;
  }

  // How far each joint of `start` is beyond the last torque, away from zero, N m.
  [[nodiscard]] Joints added(const Joints& start) const noexcept {
    const Joints zero = Joints::Zero();
    return (start - torque_.cwiseMax(zero)).cwiseMax(torque_.cwiseMin(zero) - start).cwiseMax(zero);
  }

  // The part of the last torque, brought into today's set, that adds no more to any joint than the slew rate lets it.
  [[nodiscard]] Scalar part_kept(const Joints& from, const Joints& most) const noexcept {
    Scalar part(1);
    const Joints more = added(from);
    for (Eigen::Index i = 0; i < joints; ++i) {
      const Scalar length = from[i] < Scalar(0) ? -from[i] : from[i];
      if (more[i] > most[i]) part = std::min(part, (length - more[i] + most[i]) / length);
    }
    return part;
  }

  // How much of a step the slew rate lets through, the same part for all joints.
  [[nodiscard]] static Scalar part_of(const Joints& step, const Joints& most) noexcept {
    Scalar part(1);
    for (Eigen::Index i = 0; i < joints; ++i) {
      const Scalar length = step[i] < Scalar(0) ? -step[i] : step[i];
      if (length * part > most[i]) part = most[i] / length;
    }
    return part;
  }

  Settings settings_;
  Joints allowed_;                  // tau_max / SF, N m
  Joints slew_;                     // N m/s
  Joints lower_, upper_;            // rad
  Joints torque_ = Joints::Zero();  // what the device has, N m
  Time last_{};
  bool started_ = false, resumed_ = false;  // resumed: reset since the last call
  FaultReason reason_ = FaultReason::none;
};

}  // namespace limpid
