// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/dormand_prince.hpp>
#include <limpid/core/expect.hpp>
#include <limpid/core/finite.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/arm_hardware.hpp>
#include <limpid/device/haptic_device.hpp>
#include <limpid/robot/robot.hpp>
#include <limpid/signal/filtered_derivative.hpp>
#include <limpid/signal/quantiser.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace limpid {

/// How much of the real arm is simulated.
enum class Realism {
  ideal,      ///< exact joint angles and rates, viscous friction alone, any torque
  realistic,  ///< with its ArmHardware: encoders, filtered rates, static friction, motors and their converters
};

/// Whether the operator's hand, whose force is played, acts on the arm.
enum class OperatorCoupling { on_arm, playback };

/// The dynamics (3.15) of any Robot behind the face of a device.
///
/// Between calls of `advance` the written torque is held, and the arm is integrated to a local error of 1e-10. On an
/// ideal arm the operator's joint torque J' F_h of the earlier tick is held too, so that the -J' F_h of a controller
/// cancels it exactly. On a realistic one the force is linear in time and acts through the J of the moving arm, and its
/// hardware is as ArmHardware says.
///
/// The arm has no mechanical stops: it can be moved beyond the limits of its joints. Where a robot has no pose, such as
/// a five-bar that would have to open its loop, it stays before that, `not_finite`, until it is drawn away.
/// @realtime  advance, read, write: no allocation, no throw; read and write a few copies. advance is a simulation, not
///            a part of a hard real-time tick: it takes as many steps as the motion needs, up to the bound of 60 000
///            calls of the dynamics, after which it is `limited`
template <Robot R>
class SimulatedArm {
 public:
  using Scalar = RobotScalar<R>;
  static constexpr int joints = RobotTraits<R>::joints;
  using Vector = JointVector<R>;
  using Force = Eigen::Matrix<Scalar, 3, 1>;
  using Parameters = RobotParameters<R>;

  struct Settings {
    R robot{};
    Parameters theta =
        Parameters::Constant(std::numeric_limits<Scalar>::quiet_NaN());      ///< of the simulated arm, with H > 0
    Vector q0 = Vector::Constant(std::numeric_limits<Scalar>::quiet_NaN());  ///< angles at the start, at rest, rad
    Realism realism = Realism::ideal;
    ArmHardware<joints, Scalar> hardware{};  ///< of a realistic arm
    OperatorCoupling coupling = OperatorCoupling::on_arm;
    std::array<bool, 3> locked{};  ///< axes of the base frame along which a clamp holds the tip, fewer than joints
  };

  /// @param name  of the device, for messages
  /// @throws std::invalid_argument  where theta or q0 is not finite, H not positive definite at q0, a locked axis is
  ///                                one along which the tip cannot move at q0, or the hardware cannot be
  explicit SimulatedArm(const Settings& settings, const std::string& name = "SimulatedArm")
      : settings_{checked(settings, name)},
        encoder_{{.step = settings.hardware.encoder_step.array()}},
        clamped_{clamp_of(settings)} {
    const ArmHardware<joints, Scalar>& hardware = settings_.hardware;
    derivative_ = FilteredDerivative<joints, Scalar>({.time_constant = hardware.rate_filter});
    if (hardware.converter_bits > 0) converter_ = Quantiser<joints, Scalar>({.step = hardware.converter_step()});
    state_ << settings.q0.array(), Vector::Zero().array(), Vector::Zero().array();
    seen_.q = realistic() ? Vector(encoder_.update(settings.q0.array()).value) : settings.q0;
    seen_.status = Status::no_sample;
  }

  /// Moves the arm to `now`. The first call only sets the clock.
  /// @param F_h  operator's force on the tip at `now`, N, base frame
  /// @return     `ok`; or, with nothing changed, `not_finite`, `clock_backwards`, or `limited` where the motion is too
  ///             fast to be followed. Where it could not be followed in the last call either, the arm is stopped where
  ///             it was, and moves on from there, from `now`
  [[nodiscard]] Status advance(Time now, const Force& F_h) noexcept {
    if (!is_finite(F_h)) return Status::not_finite;
    Status status = Status::ok;
    if (started_) {
      if (now <= now_) return Status::clock_backwards;
      status = integrate(state_, in_seconds<Scalar>(elapsed(now, now_)), F_h);
      const bool again = std::exchange(lost_, status != Status::ok);
      if (lost_ && !again) return status;
      if (lost_) state_.template segment<joints>(joints).setZero();  // else what held it up would do so for ever
    }
    started_ = true;
    now_ = now;
    F_h_ = F_h;
    held_operator_torque_ = at(angles(state_)).jacobian().transpose() * F_h_;
    if (connected_) sense();
    return status;
  }

  /// What the sensors gave at the last `advance`; `stale` where that was not at `now`, `no_sample` before the first.
  [[nodiscard]] DeviceState<joints, Scalar> read(Time now) noexcept {
    DeviceState<joints, Scalar> answer = seen_;
    answer.status |= when(!connected_, Status::disconnected) | when(started_ && now != seen_.stamp, Status::stale);
    return answer;
  }

  /// Holds the torque from now on; `limited` where the motors or their converter cannot reach it.
  [[nodiscard]] Status write(const SafeTorque<joints, Scalar>& torque) noexcept {
    if (!connected_) return Status::disconnected;
    motor_torque_ = torque.value();
    if (!realistic()) return Status::ok;
    const auto& hardware = settings_.hardware;
    motor_torque_ = motor_torque_.cwiseMin(hardware.highest_torque()).cwiseMax(-hardware.torque);
    const Status status = when(motor_torque_ != torque.value(), Status::limited);
    if (converter_) motor_torque_ = converter_->update(motor_torque_.array()).value;
    return status;
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
  using Square = Eigen::Matrix<Scalar, 3, 3>;

  static Vector angles(const State& state) noexcept { return state.template head<joints>(); }
  static Vector rates(const State& state) noexcept { return state.template segment<joints>(joints); }
  static Vector bends(const State& state) noexcept { return state.template tail<joints>(); }

  static const Settings& checked(const Settings& settings, const std::string& name) {
    expect(is_finite(settings.q0), name + ": q0", "finite", settings.q0);
    expect(is_finite(settings.theta), name + ": theta", "finite", settings.theta);
    const auto pose = RobotTraits<R>::at(settings.robot, settings.q0);
    const JointMatrix<R> H = pose.H(settings.theta);
    const Eigen::LLT<JointMatrix<R>> factor(H);
    expect(is_finite(H) && factor.info() == Eigen::Success, name + ": theta", "with a positive definite H at q0",
           settings.theta);
    settings.hardware.check(name);
    const JacobianMatrix<R> J = pose.jacobian();
    const Square mobility = clamped_mobility(J, factor.solve(JointMatrix<R>::Identity()), clamp_of(settings));
    const int held = static_cast<int>(std::count(settings.locked.begin(), settings.locked.end(), true));
    expect(held < joints && Eigen::LLT<Square>(mobility).info() == Eigen::Success, name + ": locked",
           "fewer axes than joints, along which the tip can move", held);
    return settings;
  }

  // 1 for a locked axis, 0 for a free one
  static Force clamp_of(const Settings& settings) noexcept {
    return {Scalar(settings.locked[0] ? 1 : 0), Scalar(settings.locked[1] ? 1 : 0), Scalar(settings.locked[2] ? 1 : 0)};
  }

  // A H^-1 A', where A has the rows of J that are locked, and ones for the free axes, 1/kg
  static Square clamped_mobility(const JacobianMatrix<R>& A, const JointMatrix<R>& inverse,
                                 const Force& clamped) noexcept {
    Square mobility = clamped.asDiagonal() * (A * inverse * A.transpose()) * clamped.asDiagonal();
    mobility.diagonal() += Force::Ones() - clamped;
    return mobility;
  }

  [[nodiscard]] bool realistic() const noexcept { return settings_.realism == Realism::realistic; }
  [[nodiscard]] bool felt() const noexcept { return settings_.coupling == OperatorCoupling::on_arm; }
  [[nodiscard]] auto at(const Vector& q) const noexcept { return RobotTraits<R>::at(settings_.robot, q); }

  Status integrate(State& state, const Scalar& dt, const Force& F_h) const noexcept {
    if (!realistic()) {
      const Vector torque = felt() ? Vector(motor_torque_ + held_operator_torque_) : motor_torque_;
      return integrator_.advance(state, Scalar(0), dt, [&](const Scalar&, const State& y) {
        return motion(at(angles(y)), y, torque, Vector::Zero());
      });
    }
    const Vector f_s = settings_.hardware.static_friction;
    const Scalar z_s = settings_.hardware.presliding;
    return integrator_.advance(state, Scalar(0), dt, [&](const Scalar& t, const State& y) {
      const auto arm = at(angles(y));
      const Vector qdot = rates(y), bend = bends(y);
      Vector torque = motor_torque_ - f_s.cwiseProduct(bend);
      if (felt()) torque += arm.jacobian().transpose() * (F_h_ + (t / dt) * (F_h - F_h_));
      return motion(arm, y, torque, (qdot - qdot.cwiseAbs().cwiseProduct(bend)) / z_s);
    });
  }

  // (3.15) solved for q''; once for all of the integrator's stages
  [[nodiscard, gnu::noinline]] State motion(const PoseOf<R>& arm, const State& y, const Vector& torque,
                                            const Vector& bending) const noexcept {
    const Vector qdot = rates(y);
    const Vector driving = torque - arm.torque(settings_.theta, qdot, qdot, Vector::Zero());
    const JointMatrix<R> inverse = arm.H(settings_.theta).inverse();
    Vector qddot = inverse * driving;
    if (!clamped_.isZero(Scalar(0))) qddot = held_still(arm, qdot, inverse, qddot);
    State slope;
    slope << qdot, qddot, bending;
    return slope;
  }

  // q'' that the clamp's force leaves, with no acceleration of the tip along the locked axes: A q'' + A' q' = 0 where
  // A has the rows of J that are locked. What rounding leaves of their velocity dies away within 10 ms.
  [[nodiscard, gnu::noinline]] Vector held_still(const PoseOf<R>& arm, const Vector& qdot,
                                                 const JointMatrix<R>& inverse, const Vector& qddot) const noexcept {
    const JacobianMatrix<R> A = clamped_.asDiagonal() * JacobianMatrix<R>(arm.jacobian());
    const JacobianMatrix<R> A_dot = clamped_.asDiagonal() * JacobianMatrix<R>(arm.jacobian_dot(qdot));
    const Square mobility = clamped_mobility(A, inverse, clamped_);
    const Force clamp = mobility.inverse() * (A * qddot + A_dot * qdot + Scalar(100) * (A * qdot));
    return qddot - inverse * (A.transpose() * clamp);
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
  Quantiser<joints, Scalar> encoder_;
  std::optional<Quantiser<joints, Scalar>> converter_{};
  FilteredDerivative<joints, Scalar> derivative_{};  // (5.3)
  DormandPrince<State> integrator_{};
  State state_;
  Force clamped_;                                 // of clamp_of
  Vector motor_torque_ = Vector::Zero();          // N m
  Vector held_operator_torque_ = Vector::Zero();  // J' F_h at now_, N m
  Force F_h_ = Force::Zero();                     // at now_, N
  Time now_{};
  bool started_ = false, connected_ = true;
  bool lost_ = false;                   // whether the last call's motion could not be followed
  DeviceState<joints, Scalar> seen_{};  // what the sensors gave last
};

}  // namespace limpid
