// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/dormand_prince.hpp>
#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/haptic_device.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/signal/filtered_derivative.hpp>
#include <limpid/signal/quantiser.hpp>

#include <Eigen/LU>

#include <cmath>

namespace limpid {

/// How much of the real arm is simulated.
enum class Realism {
  ideal,      ///< exact joint angles and rates, viscous friction alone, any torque
  realistic,  ///< encoders, filtered rates, static friction, torque limits
};

/// Whether the operator's hand, whose force is played, acts on the arm.
enum class OperatorCoupling { on_arm, playback };

/// The Omni's dynamics (3.15) behind the face of a device.
///
/// Between calls of `advance` the written torque is held, and the arm is integrated to a local error of 1e-10. On an
/// ideal arm the operator's joint torque J' F_h of the earlier tick is held too, so that the -J' F_h of a controller
/// cancels it exactly. On a realistic one the force is linear in time and acts through the J of the moving arm, and
///
///  - the motors give no more than the torques of Table 5.1;
///  - each joint has static friction after Dahl: z' = q' - |q'| z/z_s, torque f_s z/z_s, with f_s of Table 5.1 and
///    z_s = 5e-4 rad of bending before it slips;
///  - angles are read in steps of 4e-4 rad and rates through the 4 Hz filter (5.3) from them.
///
/// The arm has no mechanical stops: it can be moved beyond the limits of its joints.
/// @realtime  advance, read, write: no allocation, no throw; read and write a few copies. advance is a simulation, not
/// a
///            part of a hard real-time tick: a tick of 1 ms costs some 10 us, and up to 100 us under 100 N; the harder
///            the arm is thrown the more (1 ms at 1e6 N), up to the bound of 60 000 calls of the dynamics, 10 to 30 ms,
///            after which it is `limited`
template <Real Scalar_ = double>
class SimulatedOmni {
 public:
  using Scalar = Scalar_;
  static constexpr int joints = Omni<Scalar>::joints;
  using Vector = Eigen::Matrix<Scalar, joints, 1>;
  using Parameters = typename Omni<Scalar>::Parameters;

  struct Settings {
    Omni<Scalar> robot{};
    Parameters theta = Omni<Scalar>::table_5_2();  ///< of the simulated arm, with H > 0
    Vector q0 = start_pose();                      ///< angles at the start, at rest, rad
    Realism realism = Realism::ideal;
    OperatorCoupling coupling = OperatorCoupling::on_arm;
  };

  /// @throws std::invalid_argument  where theta or q0 is not finite, or H not positive definite at q0
  explicit SimulatedOmni(const Settings& settings)
      : settings_{settings}, limits_{settings.robot.limits()}, encoder_{{.step = encoder_step()}} {
    expect(is_finite(settings.q0), "SimulatedOmni: q0", "finite", settings.q0);
    expect(is_finite(settings.theta), "SimulatedOmni: theta", "finite", settings.theta);
    const auto H = settings.robot.at(settings.q0).H(settings.theta);
    expect(H(0, 0) > Scalar(0) && H(2, 2) > Scalar(0) && H(1, 1) * H(2, 2) > H(1, 2) * H(2, 1), "SimulatedOmni: theta",
           "with a positive definite H at q0", settings.theta);
    state_ << settings.q0.array(), Vector::Zero().array(), Vector::Zero().array();
    seen_.q = realistic() ? Vector(encoder_.update(settings.q0.array()).value) : settings.q0;
    seen_.status = Status::no_sample;
  }

  /// (0, pi/4, -1.25), thesis notes' start of section 6.1.4, rad.
  [[nodiscard]] static Vector start_pose() noexcept {
    using std::atan;
    return {Scalar(0), atan(Scalar(1)), Scalar(-5) / Scalar(4)};
  }

  /// Moves the arm to `now`. The first call only sets the clock.
  /// @param F_h  operator's force on the tip at `now`, N, base frame
  /// @return     `ok`; or, with the arm where it was, `not_finite`, `clock_backwards`, or `limited` where the motion is
  ///             too fast to be followed
  [[nodiscard]] Status advance(Time now, const Vector& F_h) noexcept {
    if (!is_finite(F_h)) return Status::not_finite;
    if (started_) {
      if (now <= now_) return Status::clock_backwards;
      State state = state_;
      const Status status = integrate(state, in_seconds<Scalar>(elapsed(now, now_)), F_h);
      if (status != Status::ok) return status;
      state_ = state;
    }
    started_ = true;
    now_ = now;
    F_h_ = F_h;
    held_operator_torque_ = pose().jacobian().transpose() * F_h_;
    if (connected_) sense();
    return Status::ok;
  }

  /// What the sensors gave at the last `advance`; `stale` where that was not at `now`, `no_sample` before the first.
  [[nodiscard]] DeviceState<joints, Scalar> read(Time now) noexcept {
    DeviceState<joints, Scalar> answer = seen_;
    answer.status |= when(!connected_, Status::disconnected) | when(started_ && now != seen_.stamp, Status::stale);
    return answer;
  }

  /// Holds the torque from now on.
  [[nodiscard]] Status write(const SafeTorque<joints, Scalar>& torque) noexcept {
    if (!connected_) return Status::disconnected;
    motor_torque_ = torque.value();
    if (!realistic()) return Status::ok;
    motor_torque_ = motor_torque_.cwiseMin(limits_.torque).cwiseMax(-limits_.torque);
    return when(motor_torque_ != torque.value(), Status::limited);
  }

  /// Pulls the plug: the motors have no torque, and no call of the device's face gets through until `reconnect`.
  void disconnect() noexcept {
    connected_ = false;
    motor_torque_.setZero();
  }

  /// Plugs it in again; without torque until the next `write`.
  void reconnect() noexcept { connected_ = true; }

  /// Where the arm really is.
  [[nodiscard]] JointState<joints, Scalar> true_state() const noexcept { return {angles(state_), rates(state_)}; }

 private:
  using State = Eigen::Matrix<Scalar, 3 * joints, 1>;  // q, q', z/z_s

  static Vector angles(const State& state) noexcept { return state.template head<joints>(); }
  static Vector rates(const State& state) noexcept { return state.template segment<joints>(joints); }
  static Vector bends(const State& state) noexcept { return state.template tail<joints>(); }

  static Scalar presliding() noexcept { return Scalar(5) / Scalar(10'000); }  // z_s, rad
  static Eigen::Array<Scalar, joints, 1> encoder_step() noexcept {
    return Eigen::Array<Scalar, joints, 1>::Constant(Scalar(4) / Scalar(10'000));  // rad, section 5.2
  }

  [[nodiscard]] bool realistic() const noexcept { return settings_.realism == Realism::realistic; }
  [[nodiscard]] bool felt() const noexcept { return settings_.coupling == OperatorCoupling::on_arm; }
  [[nodiscard]] OmniPose<Scalar> pose() const noexcept { return settings_.robot.at(angles(state_)); }

  Status integrate(State& state, const Scalar& dt, const Vector& F_h) const noexcept {
    if (!realistic()) {
      const Vector torque = felt() ? Vector(motor_torque_ + held_operator_torque_) : motor_torque_;
      return integrator_.advance(state, Scalar(0), dt, [&](const Scalar&, const State& at) {
        return motion(settings_.robot.at(angles(at)), at, torque, Vector::Zero());
      });
    }
    return integrator_.advance(state, Scalar(0), dt, [&](const Scalar& t, const State& at) {
      const auto arm = settings_.robot.at(angles(at));
      const Vector qdot = rates(at), bend = bends(at);
      Vector torque = motor_torque_ - limits_.static_friction.cwiseProduct(bend);
      if (felt()) torque += arm.jacobian().transpose() * (F_h_ + (t / dt) * (F_h - F_h_));
      return motion(arm, at, torque, (qdot - qdot.cwiseAbs().cwiseProduct(bend)) / presliding());
    });
  }

  // (3.15) solved for q''
  [[nodiscard]] State motion(const OmniPose<Scalar>& arm, const State& at, const Vector& torque,
                             const Vector& bending) const noexcept {
    const Vector qdot = rates(at);
    const Vector driving = torque - arm.torque(settings_.theta, qdot, qdot, Vector::Zero());
    State slope;
    slope << qdot, arm.H(settings_.theta).inverse() * driving, bending;
    return slope;
  }

  void sense() noexcept {
    seen_.q = angles(state_);
    seen_.qdot = rates(state_);
    if (realistic()) {
      seen_.q = encoder_.update(seen_.q.array()).value;
      seen_.qdot = derivative_.update(now_, seen_.q.array()).value;
    }
    seen_.stamp = now_;
    seen_.status = Status::ok;
  }

  Settings settings_;
  JointLimits<joints, Scalar> limits_;
  Quantiser<joints, Scalar> encoder_;
  FilteredDerivative<joints, Scalar> derivative_{};  // (5.3)
  DormandPrince<State> integrator_{};
  State state_;
  Vector motor_torque_ = Vector::Zero();          // N m
  Vector held_operator_torque_ = Vector::Zero();  // J' F_h at now_, N m
  Vector F_h_ = Vector::Zero();                   // at now_, N
  Time now_{};
  bool started_ = false, connected_ = true;
  DeviceState<joints, Scalar> seen_{};  // what the sensors gave last
};

}  // namespace limpid
