// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/omni_safety.hpp>
#include <limpid/control/safety_limiter.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/usb/usb_omni.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_device.hpp>

#include "emulator/emulated_bus.hpp"
#include "emulator/emulated_omni.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

namespace limpid::test {

/// Waits, at most half a minute, until the condition holds. @return  whether it does
template <typename Condition>
bool comes(Condition&& condition) {
  const Time end = steady_now() + std::chrono::seconds(30);
  while (steady_now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return condition();
}

/// A machine's USB with a live emulated Omni on it, docked at its start pose, and a loop of about 1 kHz that holds it.
struct UsbBench {
  using Vector = Eigen::Vector3d;

  static constexpr double full_scale = 0.3;  // N m

  static emulator::EmulatedOmni::Settings docked_at_start(const Vector& q0 = SimulatedOmni<>::start_pose()) {
    emulator::EmulatedOmni::Settings settings;
    settings.arm.q0 = q0;
    settings.arm.home = OmniDevice<>::device_joints(q0);
    settings.arm.full_scale = Vector::Constant(full_scale);
    settings.docked = true;
    return settings;
  }

  explicit UsbBench(const emulator::EmulatedOmni::Settings& settings = docked_at_start())
      : emulated{settings}, omni(bus, settings) {}

  [[nodiscard]] UsbOmni::Settings settings() const {
    UsbOmni::Settings settings;
    settings.calibration.full_scale = emulated.arm.full_scale;
    settings.calibration.home = emulated.arm.home;
    settings.ramp = std::chrono::milliseconds(20);
    // Far beyond the defaults: what trips is the fault under test, not a machine that has other work too.
    settings.link.device_watchdog = settings.link.host_watchdog = std::chrono::milliseconds(500);
    settings.link.stale_after = std::chrono::milliseconds(300);
    return settings;
  }

  /// A torque that a limiter of the Omni lets through in a tick.
  [[nodiscard]] SafeTorque<3> torque(Time now, const DeviceState<3>& seen, const Vector& wanted) {
    return limiter.limit(now, seen.joint_state(), wanted, Status::ok).torque;
  }

  /// Loops at about 1 kHz until `done(seen)` holds, or for half a minute.
  /// @return  whether it held
  template <typename Done>
  bool loop(UsbOmni& device, const Vector& wanted, Done&& done) {
    const Time end = steady_now() + std::chrono::seconds(30);
    while (steady_now() < end) {
      const Time now = steady_now();
      const auto seen = device.read(now);
      if (done(seen)) return true;
      if (limiter.reason() != FaultReason::none) limiter.reset(now);
      (void)device.write(torque(now, seen, wanted));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }

  /// Docks, draws out, and waits until the motors are on.
  bool start(UsbOmni& device, const Vector& wanted = Vector::Zero()) {
    omni.set_docked(true);
    if (!loop(device, wanted, [&](const auto&) { return device.calibrated(); })) return false;
    omni.set_docked(false);
    return loop(device, wanted, [&](const auto&) { return !device.docked() && omni.snapshot().motors_on; });
  }

  /// Clears the fault, again where its cause was still there, and starts.
  bool clear_and_start(UsbOmni& device, const Vector& wanted) {
    return loop(device, wanted,
                [&, cleared = Time{}](const auto& seen) mutable {
                  if (has(seen.status, Status::fault) && steady_now() - cleared > std::chrono::milliseconds(100)) {
                    device.clear_fault();
                    cleared = steady_now();
                  }
                  return !has(seen.status, Status::fault) && steady_now() - cleared > std::chrono::milliseconds(100);
                }) &&
           start(device, wanted);
  }

  emulator::EmulatedOmni::Settings emulated;
  emulator::EmulatedBus bus;
  emulator::EmulatedOmni omni;
  SafetyLimiter<Omni<>> limiter{SafetyLimiter<Omni<>>::Settings{}};
};

}  // namespace limpid::test
