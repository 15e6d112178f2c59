// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/safety_limiter.hpp>
#include <limpid/device/simulated_omni.hpp>
#include <limpid/robot/omni_device.hpp>

#include <array>
#include <cstdint>
#include <functional>

namespace limpid::emulator {

/// The Omni's arm, motors and encoders, with the hand that holds it.
class EmulatedArm {
 public:
  using Vector = Eigen::Vector3d;
  using Force = std::function<Vector(double)>;  ///< on the tip, N, base frame, after so many s
  using Counts = std::array<std::int16_t, 3>;

  struct Settings {
    Vector q0 = SimulatedOmni<>::start_pose();  ///< where the hand holds it at first, rad, of the model
    Realism realism = Realism::realistic;
    OperatorCoupling coupling = OperatorCoupling::on_arm;
    Vector full_scale = Vector(0.3, 0.29, 0.2);  ///< command torque at u = 1, N m
    Vector home = Vector(0, 0.23, -0.37);        ///< device joint angles where the counts were zero, rad
    Force force{};
  };

  explicit EmulatedArm(const Settings& settings);

  /// Holds the torque of the converters from now on.
  void write(const std::array<std::uint16_t, 3>& dac);
  /// Moves on by `dt`; held still by the hand until `let_go`, from when the time of its force counts.
  void advance(Duration dt);
  void let_go() { free_ = true; }
  void set_force(Force force) { settings_.force = std::move(force); }
  /// The encoders count from zero where the arm is.
  void zero_counts();
  /// The encoders count from zero at these device joint angles, rad.
  void zero_counts(const Vector& home) { zero_ = home; }

  [[nodiscard]] Counts counts() const;
  [[nodiscard]] const Vector& torque() const { return torque_; }  ///< of the motors at the joints, N m
  [[nodiscard]] const Vector& force() const { return F_h_; }      ///< N
  [[nodiscard]] JointState<3> state() const { return arm_.true_state(); }

 private:
  // Nothing limits a board's torque but its motors: an Omni without limits makes the torques.
  struct Unlimited : Omni<double> {
    Unlimited() = default;  // no aggregate: the constructor of Omni is explicit
    [[nodiscard]] static JointLimits<3> limits() noexcept;
  };

  Settings settings_;
  SimulatedOmni<> arm_;
  SafetyLimiter<Unlimited> gate_;
  Vector zero_;
  Vector torque_ = Vector::Zero(), F_h_ = Vector::Zero();
  Time now_{}, let_go_{};
  bool free_ = false, started_ = false;
};

}  // namespace limpid::emulator
