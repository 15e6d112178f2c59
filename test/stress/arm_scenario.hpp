// SPDX-License-Identifier: MIT
#pragma once

#include "clock.hpp"
#include "corruption.hpp"
#include "trial.hpp"

#include <limpid/control/safety_limiter.hpp>
#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/robot/omni.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace limpid::stress {

/// Where an arm is put.
inline Choice pose_choice() {
  return {"pose", {"at rest", "inside its limits", "straight or over its base", "absurd"}};
}

template <typename Scalar>
Eigen::Matrix<Scalar, 3, 1> drawn_pose(int kind, Random& random) {
  const double a = random.uniform(-1, 1), b = random.uniform(-1, 1), c = random.uniform(-1, 1);
  const double near = random.decades(-18, -1), size = random.decades(-3, 4);
  using Joints = Eigen::Matrix<Scalar, 3, 1>;
  if (kind == 0) return Joints(Scalar(0), Scalar(0.785), Scalar(-1.25));
  if (kind == 1) return Joints(Scalar(a), Scalar(0.895 + 0.85 * b), Scalar(-1.35 + c));
  if (kind == 2) return Joints(Scalar(a), Scalar(1.57 + near), Scalar(c < 0 ? near : -0.25 - 0.1 * c));
  return Joints(Scalar(size * a), Scalar(size * b), Scalar(size * c));
}

/// SlotineLiAdaptive and SafetyLimiter of an Omni at any pose, after any reference.
template <typename Scalar>
class ArmStress {
 public:
  static std::vector<Choice> choices() {
    return {pose_choice(), clock_choice(), corruption_choice(), {"reference", {"near", "far", "absurd"}}};
  }

  static Outcome play(const Trial& trial) {
    ArmStress arm(trial);
    return play_ticks(trial, arm.watch_, [&](bool seen, Random& random) { arm.tick(seen, random); });
  }

 private:
  using Arm = Omni<Scalar>;
  using Joints = Eigen::Matrix<Scalar, 3, 1>;
  using Parameters = typename Arm::Parameters;
  static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

  explicit ArmStress(const Trial& trial)
      : pose_{trial.choices[0]},
        clock_{trial.choices[1]},
        corruption_{trial.choices[2], 0.003},
        reference_{trial.choices[3]},
        controller_({.robot = Arm{},
                     .Lambda = Joints(Scalar(2.8), Scalar(3), Scalar(1.5)),
                     .Kd = Joints(Scalar(0.4), Scalar(0.28), Scalar(0.1)),
                     .Gamma = Parameters::Constant(Scalar(0.001)),
                     .theta0 = Arm::table_5_2(),
                     .lower = Arm::table_5_2() / Scalar(2),
                     .upper = Arm::table_5_2() * Scalar(2)}),
        limiter_({}) {}

  Joints vector(double size, Random& random) {
    Joints v;
    for (int i = 0; i < 3; ++i) v[i] = corruption_(Scalar(size * random.uniform(-1, 1)), random);
    return v;
  }

  void tick(bool seen, Random& random) {
    const Time now = clock_.next(random);
    if (count_++ % 8 == 0) q_ = drawn_pose<Scalar>(pose_, random);
    const double size = reference_ == 0 ? 0.1 : reference_ == 1 ? 1e3 : random.decades(-30, 30);
    const JointState<3, Scalar> is{q_ + vector(1e-3, random), vector(1, random)};
    DesiredJoints<3, Scalar> wanted;
    wanted.q = q_ + vector(size, random);
    wanted.qdot = vector(size, random);
    wanted.qddot = vector(size, random);
    const Joints F_h = vector(5, random);
    const bool reset = random.chance(0.5);
    if (seen) judge(now, is, wanted, F_h, reset);
  }

  void judge(Time now, const JointState<3, Scalar>& is, const DesiredJoints<3, Scalar>& wanted, const Joints& F_h,
             bool reset) {
    const auto [tau, status] = controller_.update(now, is, wanted, F_h, torque_);
    watch_.require("the wanted torque is finite", is_finite(tau));
    const Parameters& theta = controller_.theta_hat();
    watch_.require("theta_hat is within its bounds", (theta.array() >= Arm::table_5_2().array() / Scalar(2)).all() &&
                                                         (theta.array() <= Arm::table_5_2().array() * Scalar(2)).all());
    if (reset && limiter_.reason() != FaultReason::none) {
      limiter_.reset(now);
      last_ = now;
      torque_.setZero();
    }
    const auto safe = limiter_.limit(now, is, tau);
    judge_torque(safe.torque.value(), in_seconds<Scalar>(elapsed(now, last_)));
    const bool fault = limiter_.reason() != FaultReason::none;
    watch_.require("a fault has no torque", fault == has(safe.status, Status::fault));
    if (fault) watch_.require("a fault has no torque", safe.torque.value() == Joints::Zero());
    if (!fault) last_ = now;
    torque_ = safe.torque.value();
  }

  void judge_torque(const Joints& tau, const Scalar& dt) {
    const Joints most = Arm{}.limits().torque / Scalar(1.3);
    for (int i = 0; i < 3; ++i) {
      watch_.at_most("torque over its limit", double(std::abs(tau[i]) / most[i]), 1 + 4 * double(epsilon));
      const Scalar rise = 100 * most[i] * std::max(dt, Scalar(0)) * (1 + 4 * epsilon) + most[i] * epsilon;
      watch_.require("no torque rises faster than it may", tau[i] <= std::max(torque_[i], Scalar(0)) + rise &&
                                                               tau[i] >= std::min(torque_[i], Scalar(0)) - rise);
    }
  }

  int pose_;
  Clock clock_;
  Corruption corruption_;
  int reference_;
  SlotineLiAdaptive<Arm> controller_;
  SafetyLimiter<Arm> limiter_;
  Joints q_ = Joints::Zero(), torque_ = Joints::Zero();
  Time last_{};
  std::uint64_t count_ = 0;
  Watch watch_;
};

template <typename Scalar>
Scenario arm_scenario(const std::string& scalar, double share) {
  return {"SlotineLiAdaptive and SafetyLimiter, " + scalar, ArmStress<Scalar>::choices(), &ArmStress<Scalar>::play,
          share};
}

inline std::vector<Scenario> arm_scenarios() {
  return {arm_scenario<double>("double", 3), arm_scenario<float>("float", 3)};
}

}  // namespace limpid::stress
