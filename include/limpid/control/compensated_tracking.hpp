// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/friction_compensator.hpp>
#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/control/velocity_observer.hpp>
#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/robot/joint_state.hpp>
#include <limpid/robot/robot.hpp>

namespace limpid {

/// Tracking on an arm with encoders and static friction: SlotineLiAdaptive on the state of a VelocityObserver, with the
/// torque of a FrictionCompensator added; each told what it must hear. Stands wherever SlotineLiAdaptive does in a
/// loop.
///
/// What theory covers is said there, part by part. The observer's error adds to epsilon: (4.7) with delta^ in place of
/// delta, in which K_d (delta^ - delta) and what phi_r makes of it are bounded where the observer's error is.
///
/// Adaptation would integrate what static friction leaves of delta while the arm sticks, until it slips, again and
/// again: a limit cycle, which was seen. So nothing is adapted while all joints are wanted to rest. Gains of the Omni
/// that a search found for a share of .95, a presliding of 6.2e-4 rad and a bandwidth of 110 rad/s: .57 K_d and 4.45
/// Lambda of (5.6), a tenth of (5.7)'s Gamma.
/// @tparam R  a Robot of n joints and p parameters
/// @realtime  update: no allocation, no throw
template <Robot R>
class CompensatedTracking {
 public:
  using Scalar = RobotScalar<R>;
  static constexpr int joints = RobotTraits<R>::joints;
  using Joints = JointVector<R>;
  using Force = Eigen::Matrix<Scalar, 3, 1>;
  using Controller = SlotineLiAdaptive<R>;
  using Observer = VelocityObserver<R>;
  using Compensator = FrictionCompensator<joints, Scalar>;

  struct Settings {
    typename Controller::Settings controller{};
    typename Observer::Settings observer{};
    typename Compensator::Settings friction{};  ///< its identifier takes the observer's bandwidth
    Scalar rest = Scalar(1) / Scalar(100);      ///< rate below which a joint is wanted to rest, rad/s, >= 0
  };

  struct Output {
    Joints tau;     ///< N m; always finite
    Status status;  ///< not_finite, clock_backwards: the last good torque, nothing changed; or what a part said
  };

  /// @throws std::invalid_argument  where a part refuses its settings
  explicit CompensatedTracking(const Settings& settings)
      : controller_(settings.controller),
        observer_(settings.observer),
        compensator_(friction_of(settings)),
        rest_{settings.rest} {
    expect(is_finite(rest_) && rest_ >= Scalar(0), "CompensatedTracking: rest", "finite and >= 0", rest_);
  }

  /// The torque that moves the joints from where they are toward `wanted` under the operator's force F_h, N, base
  /// frame.
  /// @param is       its angles; the rates come from the observer
  /// @param applied  torque that the device had since the last call, N m
  [[nodiscard]] Output update(Time now, const JointState<joints, Scalar>& is,
                              const DesiredJoints<joints, Scalar>& wanted, const Force& F_h,
                              const Joints& applied) noexcept {
    if (!is_finite(wanted)) return {tau_, Status::not_finite};
    const auto observed = observer_.update(now, is.q, applied, F_h);
    if (observed.status != Status::ok) return {tau_, observed.status};
    if ((wanted.qdot.array().abs() < rest_).all()) controller_.skip_adaptation();
    const auto own = controller_.update(now, observed.state, wanted, F_h, applied, added_);
    const Status learnt = compensator_.identify(now, observed.state, -observed.disturbance);
    const auto compensation = compensator_.update(wanted);
    const Status status = own.status | learnt | compensation.status;
    const Joints tau = own.tau + compensation.tau;
    if (!is_finite(tau)) return {tau_, status | Status::not_finite};
    added_ = compensation.tau;
    tau_ = tau;
    return {tau_, status};
  }

  [[nodiscard]] RobotParameters<R> theta_hat() const noexcept { return controller_.theta_hat(); }
  [[nodiscard]] const JointFriction<joints, Scalar>& friction() const noexcept { return compensator_.friction(); }

 private:
  static typename Compensator::Settings friction_of(const Settings& settings) {
    auto friction = settings.friction;
    friction.identifier.bandwidth = settings.observer.bandwidth;
    return friction;
  }

  Controller controller_;
  Observer observer_;
  Compensator compensator_;
  Scalar rest_;
  Joints added_ = Joints::Zero();  // the compensator's part of
  Joints tau_ = Joints::Zero();    // the last good torque
};

}  // namespace limpid
