// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/simulated_arm.hpp>
#include <limpid/robot/omni.hpp>

#include <cmath>

namespace limpid {

/// The Omni's dynamics (3.15) behind the face of a device: a SimulatedArm, of which a realistic one has
///
///  - motors that give no more than the torques of Table 5.1;
///  - the static friction of Table 5.1, with z_s = 5e-4 rad of bending before a joint slips;
///  - angles in steps of 4e-4 rad and rates through the 4 Hz filter (5.3) from them.
///
/// @realtime  as SimulatedArm; a tick of 1 ms costs some 10 us, and up to 100 us under 100 N; the harder the arm is
///            thrown the more (1 ms at 1e6 N), up to 10 to 30 ms at the bound of its work
template <Real Scalar_ = double>
class SimulatedOmni : public SimulatedArm<Omni<Scalar_>> {
  using Arm = SimulatedArm<Omni<Scalar_>>;

 public:
  using Arm::joints;
  using typename Arm::Parameters, typename Arm::Scalar, typename Arm::Vector;

  struct Settings {
    Omni<Scalar> robot{};
    Parameters theta = Omni<Scalar>::table_5_2();  ///< of the simulated arm, with H > 0
    Vector q0 = start_pose();                      ///< angles at the start, at rest, rad
    Realism realism = Realism::ideal;
    OperatorCoupling coupling = OperatorCoupling::on_arm;
  };

  /// @throws std::invalid_argument  where theta or q0 is not finite, or H not positive definite at q0
  explicit SimulatedOmni(const Settings& settings) : Arm(arm_of(settings), "SimulatedOmni") {}

  /// (0, pi/4, -1.25), thesis notes' start of section 6.1.4, rad.
  [[nodiscard]] static Vector start_pose() noexcept {
    using std::atan;
    return {Scalar(0), atan(Scalar(1)), Scalar(-5) / Scalar(4)};
  }

 private:
  static typename Arm::Settings arm_of(const Settings& settings) {
    const auto limits = settings.robot.limits();
    typename Arm::Settings arm;
    arm.robot = settings.robot;
    arm.theta = settings.theta;
    arm.q0 = settings.q0;
    arm.realism = settings.realism;
    arm.coupling = settings.coupling;
    arm.hardware.torque = limits.torque;
    arm.hardware.static_friction = limits.static_friction;
    arm.hardware.encoder_step.setConstant(Scalar(4) / Scalar(10'000));  // section 5.2
    return arm;
  }
};

}  // namespace limpid
