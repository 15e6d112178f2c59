// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/omni_safety.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/device/usb/usb_omni.hpp>
#include <limpid/loop/realtime/periodic_loop.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_device.hpp>

#include <emulator/emulated_bus.hpp>
#include <emulator/emulated_omni.hpp>

#include <memory>
#include <stop_token>
#include <utility>

namespace limpid::bench {

/// A machine's USB with a live emulated Omni on it, and the loop at 1 kHz of a UsbOmni that holds the arm. Watchdogs
/// are the library's defaults.
class Rig {
 public:
  using Vector = Eigen::Vector3d;

  static emulator::EmulatedOmni::Settings emulated() {
    emulator::EmulatedOmni::Settings settings;
    settings.arm.q0 = SimulatedOmni<>::start_pose();
    settings.arm.home = OmniDevice<>::device_joints(settings.arm.q0);
    settings.arm.full_scale = Vector::Constant(0.3);
    settings.docked = true;
    return settings;
  }

  static UsbOmni::Settings adapter(Duration ramp = std::chrono::milliseconds(20)) {
    UsbOmni::Settings settings;
    settings.calibration.full_scale = emulated().arm.full_scale;
    settings.calibration.home = emulated().arm.home;
    settings.ramp = ramp;
    return settings;
  }

  /// What the loop wants: a spring to where the arm was, and a torque besides, so that there always is one.
  static Vector wanted(const DeviceState<3>& seen) {
    return Vector(0.03, 0.05, 0.02) - 0.5 * (seen.q - SimulatedOmni<>::start_pose()) - 0.01 * seen.qdot;
  }

  /// One tick of the loop but for what the device is told.
  SafeTorque<3> torque(Time now, const DeviceState<3>& seen) noexcept {
    if (limiter_.reason() != FaultReason::none) limiter_.reset(now);
    return limiter_.limit(now, seen.joint_state(), wanted(seen)).torque;
  }

  /// Ticks of `omni` until `done(seen, tick)`, or for so long. @return whether it was done
  template <typename Done>
  bool loop(Duration longest, Done&& done, bool writes = true) {
    bool is_done = false;
    PeriodicLoop loop({.period = std::chrono::milliseconds(1), .duration = longest});
    loop.run(std::stop_token{}, [&](const TickTime& at) noexcept {
      const auto seen = omni->read(at.now);
      is_done = done(seen, at);
      if (!is_done && writes) (void)omni->write(torque(at.now, seen));
      return !is_done;
    });
    return is_done;
  }

  /// Clears the fault as often as its cause is still there, docks, draws out, and waits for torque.
  bool start(Duration longest = std::chrono::seconds(5)) {
    if (!omni) omni = std::make_unique<UsbOmni>(adapter());
    device.set_docked(true);
    Time cleared{};
    return loop(longest, [&](const auto&, const TickTime& at) {
      if (omni->fault() != UsbFault::none && elapsed(at.now, cleared) > std::chrono::milliseconds(50)) {
        omni->clear_fault();
        cleared = at.now;
      }
      if (omni->fault() == UsbFault::none) device.set_docked(!omni->calibrated());
      const auto is = device.snapshot();
      return omni->fault() == UsbFault::none && is.motors_on && !is.torque.isZero(0);
    });
  }

  emulator::EmulatedBus bus{};
  emulator::EmulatedOmni device{bus, emulated()};
  std::unique_ptr<UsbOmni> omni = std::make_unique<UsbOmni>(adapter());

 private:
  SafetyLimiter<Omni<>> limiter_{SafetyLimiter<Omni<>>::Settings{}};
};

}  // namespace limpid::bench
