// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/simulated_arm.hpp>
#include <limpid/robot/five_bar.hpp>
#include <limpid/robot/five_bar_kinematics.hpp>

#include <array>
#include <cmath>

namespace limpid {

/// The five-bar's dynamics behind the face of a device: a SimulatedArm.
///
/// Eom, Suh and Yi tell of theirs, in section 5, that its torques come through a 12-bit D/A converter and its angles
/// from encoders; what a realistic one has here is a choice: the converter's steps over the whole range of the motors,
/// -2..2 N m, are 1 mN m or 5 mN at the tip, encoders have 2^16 steps a turn, 20 um at the tip, and Coulomb's friction
/// in the joints, by Dahl's law with z_s = 2e-4 rad, takes about 20 mN at the tip.
///
/// The loop closes and the tip is ahead of the elbows at q0, and stays so: before a singularity the device stops until
/// it is drawn away, and says `not_finite` or `limited`.
/// @realtime  as SimulatedArm
template <Real Scalar_ = double>
class SimulatedFiveBar : public SimulatedArm<FiveBar<Scalar_>> {
  using Arm = SimulatedArm<FiveBar<Scalar_>>;

 public:
  using Arm::joints;
  using typename Arm::Parameters, typename Arm::Scalar, typename Arm::Vector;

  struct Settings {
    FiveBar<Scalar> robot{};                            ///< whose torque is the whole range of the converter
    Parameters theta = FiveBar<Scalar>{}.theta_of({});  ///< of the simulated device, with H > 0
    Vector q0 = start_pose();                           ///< angles at the start, at rest, rad
    Realism realism = Realism::ideal;
    OperatorCoupling coupling = OperatorCoupling::on_arm;
    std::array<bool, 2> locked{};  ///< x, y: a clamp holds the tip along this axis, one at most
    int converter_bits = 12;       ///< of the torques; 0: no steps
    Vector static_friction = Vector::Constant(Scalar(2) / Scalar(1000));  ///< Coulomb's, N m
    Scalar presliding = Scalar(2) / Scalar(10'000);                       ///< bending of a joint before it slips, rad
    Vector encoder_step = Vector::Constant(turn() / Scalar(65'536));      ///< rad
    Scalar rate_filter = Scalar(5) / Scalar(10'000);                      ///< tau of (5.3), s
  };

  /// @throws std::invalid_argument  where a setting cannot be, or H is not positive definite at q0
  explicit SimulatedFiveBar(const Settings& settings) : Arm(arm_of(settings), "SimulatedFiveBar") {}

  /// Joints with the tip at (0.08, 0.22) m, rad.
  [[nodiscard]] static Vector start_pose() {
    const FiveBarKinematics<Scalar> kinematics{FiveBar<Scalar>{}};
    return kinematics.inverse({Scalar(8) / Scalar(100), Scalar(22) / Scalar(100), Scalar(0)}).q;
  }

 private:
  [[nodiscard]] static Scalar turn() noexcept {
    using std::atan;
    return Scalar(8) * atan(Scalar(1));
  }

  static typename Arm::Settings arm_of(const Settings& settings) {
    typename Arm::Settings arm;
    arm.robot = settings.robot;
    arm.theta = settings.theta;
    arm.q0 = settings.q0;
    arm.realism = settings.realism;
    arm.coupling = settings.coupling;
    arm.locked = {settings.locked[0], settings.locked[1], false};
    arm.hardware.torque = settings.robot.limits().torque;
    arm.hardware.converter_bits = settings.converter_bits;
    arm.hardware.static_friction = settings.static_friction;
    arm.hardware.presliding = settings.presliding;
    arm.hardware.encoder_step = settings.encoder_step;
    arm.hardware.rate_filter = settings.rate_filter;
    return arm;
  }
};

}  // namespace limpid
