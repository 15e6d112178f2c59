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
/// rule is broken on the way.
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
    Scalar safety_factor = Scalar(13) / Scalar(10);        ///< SF, >= 1
    std::optional<Joints> torque_limit{};                  ///< tau_max, N m, > 0; else the robot's
    std::optional<Joints> slew{};                          ///< N m/s, > 0; else from zero to tau_max / SF in 10 ms
    Scalar joint_margin = Scalar(1) / Scalar(10);          ///< from a joint limit or (5.4), rad, >= 0
    Scalar workspace_margin = Scalar(1) / Scalar(100);     ///< from an edge of the workspace, m, >= 0
    bool workspace = true;                                 ///< whether the workspace is watched
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
    expect(is_finite(most) && (most.array() > Scalar(0)).all(), "SafetyLimiter: torque_limit", "finite and > 0", most);
    allowed_ = most / settings.safety_factor;
    slew_ = settings.slew.value_or(Joints(allowed_ * Scalar(100)));
    lower_ = limits.lower;
    upper_ = limits.upper;
    expect(is_finite(slew_) && (slew_.array() > Scalar(0)).all(), "SafetyLimiter: slew", "finite and > 0", slew_);
    check_distance(settings.joint_margin, "SafetyLimiter: joint_margin");
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
    const Scalar dt = started_ ? in_seconds<Scalar>(now - last_) : Scalar(0);
    started_ = true;
    last_ = now;
    const auto allowed = allowed_at(is.q);
    const auto from = allowed.fit(torque_), to = allowed.fit(wanted);
    const Joints step = to.torque - from.torque;
    const Scalar part = part_of(step, dt);
    if (part < Scalar(1)) {
      torque_ = allowed.fit(from.torque + part * step).torque;  // takes no more than a rounding away
      return {Torque{torque_}, to.status | Status::limited};
    }
    torque_ = to.torque;
    return {Torque{torque_}, to.status};
  }

  /// Ends a fault, deliberately: torque starts again from zero, and the clock at `now`.
  void reset(Time now) noexcept {
    reason_ = FaultReason::none;
    torque_.setZero();
    last_ = now;
    started_ = true;
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
    if (started_ && now <= last_) return FaultReason::clock_backwards;
    if (started_ && now - last_ > settings_.longest_gap) return FaultReason::gap_too_long;
    const auto overshoot = is.q.cwiseMax(upper_) - upper_ + lower_ - is.q.cwiseMin(lower_);
    if ((overshoot.array() > settings_.joint_overshoot).any()) return FaultReason::joint_out_of_range;
    if (has(upstream & settings_.upstream_faults, Status::disconnected)) return FaultReason::disconnected;
    if (has(upstream, settings_.upstream_faults)) return FaultReason::upstream;
    return FaultReason::none;
  }

  [[nodiscard]] Allowed allowed_at(const Joints& q) const noexcept {
    Allowed allowed(allowed_);
    for (Eigen::Index i = 0; i < joints; ++i) {
      if (q[i] >= upper_[i] - settings_.joint_margin) allowed.forbid_positive(i, Status::joint_limit);
      if (q[i] <= lower_[i] + settings_.joint_margin) allowed.forbid_negative(i, Status::joint_limit);
    }
    SafetyTraits<R>::limit_joints(settings_.robot, q, settings_.joint_margin, allowed);
    if (settings_.workspace) SafetyTraits<R>::limit_workspace(settings_.robot, q, settings_.workspace_margin, allowed);
    return allowed;
  }

  // How much of a step the slew rate lets through, the same part for all joints.
  [[nodiscard]] Scalar part_of(const Joints& step, const Scalar& dt) const noexcept {
    Scalar part(1);
    for (Eigen::Index i = 0; i < joints; ++i) {
      const Scalar length = step[i] < Scalar(0) ? -step[i] : step[i], most = slew_[i] * dt;
      if (length * part > most) part = most / length;
    }
    return part;
  }

  Settings settings_;
  Joints allowed_;                  // tau_max / SF, N m
  Joints slew_;                     // N m/s
  Joints lower_, upper_;            // rad
  Joints torque_ = Joints::Zero();  // what the device has, N m
  Time last_{};
  bool started_ = false;
  FaultReason reason_ = FaultReason::none;
};

}  // namespace limpid
