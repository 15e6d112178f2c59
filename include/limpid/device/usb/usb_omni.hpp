// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/control/safe_torque.hpp>
#include <limpid/core/expect.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/haptic_device.hpp>
#include <limpid/device/usb/omni_bridge.hpp>
#include <limpid/device/usb/omni_calibration.hpp>
#include <limpid/device/usb/usb_fault.hpp>
#include <limpid/device/usb/usb_link.hpp>
#include <limpid/signal/filtered_derivative.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace limpid {

/// The Phantom Omni behind an OmniBridge on USB, as a HapticDevice. Never run on hardware.
///
/// The encoders know their angles once the stylus has been docked, `home` of the calibration; until then, and as long
/// as it is docked, the motors are off. When it is drawn out their torque rises from zero over `ramp`, as it does after
/// every fault. A fault takes them off and is latched until `clear_fault`: those of the link, the device's own
/// watchdog, a device that was without power, and an encoder that turns faster than a joint can. Who calls
/// `clear_fault` sees to it that the loop begins anew where the arm is: SafetyLimiter::reset. Angles and rates are by
/// the device's own clock.
/// @realtime  read, write: no allocation, no throw, no system call; .5 and .2 us in half of the ticks on a busy machine
/// (bench/usb)
class UsbOmni {
 public:
  using Scalar = double;
  static constexpr int joints = 3;
  using Vector = Eigen::Vector3d;

  struct Settings {
    OmniCalibration calibration;  ///< its full_scale has no default
    UsbLinkSettings link{};
    Duration ramp = std::chrono::milliseconds(500);                        ///< of the torque from zero, 0 to 60 s
    double rate_filter = FilteredDerivative<3>::Settings{}.time_constant;  ///< of the rates, (5.3), s, > 0
    double fastest = 30;  ///< a joint's rate, rad/s, > 0: faster is an encoder's error
  };

  /// Opens the device.
  /// @throws std::invalid_argument  where a setting cannot serve
  /// @throws UsbError               where no device, or more than one, can be opened
  explicit UsbOmni(const Settings& settings)
      : settings_{checked(settings)},
        rates_at_rest_({.time_constant = settings.rate_filter}),
        rates_(rates_at_rest_),
        link_(settings.link) {}

  /// The newest state. `now` by `steady_now`.
  [[nodiscard]] DeviceState<3> read(Time now) noexcept {
    now_ = now;
    const auto reading = link_.read(now);
    if (reading.count != taken_) take(reading);
    if (reading.fault != fault_) latch(reading.fault);
    seen_.status = reading.status | when(!docked_at_, Status::no_sample) |
                   when(fault_ != UsbFault::none, Status::fault) |
                   when(fault_ == UsbFault::disconnected, Status::disconnected);
    return seen_;
  }

  /// What the motors are to give until the next call.
  /// @return  limited: they give less, or nothing; disconnected, fault: nothing
  Status write(const SafeTorque<3>& torque) noexcept {
    motors_on_ =
        fault_ == UsbFault::none && link_.fault() == UsbFault::none && docked_at_ && !newest_.docked && !refuses();
    if (!motors_on_) {
      ramp_from_ = now_;
      return link_.write(OmniBridge::safe()) | Status::limited | when(fault_ != UsbFault::none, Status::fault);
    }
    if (torque.value().isZero(0)) ramp_from_ = now_;  // the way up begins with the first torque
    OmniBridge::Command command{.motors_on = true};
    const double risen = risen_to(now_);
    const double part = settings_.calibration.convert(risen * torque.value(), command.converter);
    return link_.write(command) | when(risen < 1 || part < 1, Status::limited);
  }

  /// Why the motors are off; `none` in normal work.
  [[nodiscard]] UsbFault fault() const noexcept { return fault_; }

  /// Ends the fault that was read, deliberately, once its cause has gone; until then it comes again. A device that was
  /// unplugged or without power must be docked once more. Without a fault nothing changes.
  void clear_fault() noexcept {
    link_.clear();
    if (fault_ == UsbFault::none) return;
    fault_ = UsbFault::none;
    ramp_from_ = now_;
  }

  /// Whether the angles are known: it has been docked.
  [[nodiscard]] bool calibrated() const noexcept { return docked_at_.has_value(); }
  [[nodiscard]] bool docked() const noexcept { return newest_.docked; }
  [[nodiscard]] const OmniBridge::State& state() const noexcept { return newest_; }  ///< as it came
  [[nodiscard]] std::uint64_t states() const noexcept { return taken_; }             ///< number of the newest
  [[nodiscard]] bool realtime() const noexcept { return link_.realtime(); }          ///< see UsbLink
  [[nodiscard]] const UsbCounters& counters() const noexcept { return link_.counters(); }

 private:
  static const Settings& checked(const Settings& settings) {
    using namespace std::chrono_literals;
    settings.calibration.check();
    expect(settings.ramp >= 0s && settings.ramp <= 60s, "UsbOmni: ramp", "from 0 to 60 s", settings.ramp);
    expect(is_finite(settings.fastest) && settings.fastest > 0, "UsbOmni: fastest", "finite and > 0", settings.fastest);
    return settings;
  }

  void take(const UsbReading<OmniBridge::State>& reading) noexcept {
    const OmniBridge::State before = newest_;
    const bool follows = taken_ > 0 && reading.opening == opening_;
    newest_ = reading.state;
    taken_ = reading.count;
    opening_ = reading.opening;
    const Duration step =
        follows ? Duration(std::chrono::microseconds(newest_.device_time - before.device_time)) : Duration::zero();
    if (!follows) docked_at_.reset();
    if (follows && newest_.boots != before.boots) latch(UsbFault::power_cycled);
    if (refuses() && motors_on_) latch(UsbFault::watchdog_off);
    if (newest_.docked) {
      docked_at_ = newest_.encoder;
      rates_ = rates_at_rest_;
    } else if (docked_at_ && has_jumped(before.encoder, step)) {
      latch(UsbFault::encoder_jumped);
    }
    if (docked_at_) show(reading.stamp, step);
  }

  void show(Time stamp, Duration step) noexcept {
    device_clock_ += step;
    seen_.q = settings_.calibration.joints(newest_.encoder, *docked_at_);
    seen_.qdot = rates_.update(device_clock_, seen_.q.array()).value;
    seen_.gimbal = settings_.calibration.gimbal(newest_.gimbal_a, newest_.gimbal_b);
    seen_.buttons = (newest_.pressed[0] ? 1U : 0U) | (newest_.pressed[1] ? 2U : 0U);
    seen_.stamp = std::max(seen_.stamp, std::min(stamp, now_));  // it may have come after `now` was taken
  }

  // Whether an encoder has turned faster since a state so long ago than a joint can.
  [[nodiscard]] bool has_jumped(const std::array<std::int16_t, 3>& before, Duration step) const noexcept {
    const double most = settings_.fastest * in_seconds(step) / settings_.calibration.count() + 4;
    bool jumped = false;
    for (std::size_t i = 0; i < before.size(); ++i) {
      jumped = jumped || std::abs(OmniCalibration::turned(before[i], newest_.encoder[i])) > most;
    }
    return jumped;
  }

  // Of the torque, since the motors were off.
  [[nodiscard]] double risen_to(Time now) const noexcept {
    if (settings_.ramp == Duration::zero()) return 1;
    return std::clamp(in_seconds(elapsed(now, ramp_from_)) / in_seconds(settings_.ramp), 0.0, 1.0);
  }

  // Until it has heard a command with motors off.
  [[nodiscard]] bool refuses() const noexcept { return newest_.watchdog_off || newest_.refuses; }

  static constexpr bool asks_for_dock(UsbFault reason) noexcept {
    return reason == UsbFault::disconnected || reason == UsbFault::power_cycled || reason == UsbFault::encoder_jumped;
  }

  // What makes the angles doubtful asks for the dock again, whatever was wrong before it, and is stated in its place.
  void latch(UsbFault reason) noexcept {
    if (asks_for_dock(reason)) docked_at_.reset();
    if (fault_ == UsbFault::none || asks_for_dock(reason)) fault_ = reason;
  }

  Settings settings_;
  const FilteredDerivative<3> rates_at_rest_;
  FilteredDerivative<3> rates_;
  UsbLink<OmniBridge> link_;
  DeviceState<3> seen_{};
  OmniBridge::State newest_{};
  std::optional<std::array<std::int16_t, 3>> docked_at_;  // the encoders, where it was docked last
  std::uint64_t taken_ = 0;
  std::uint32_t opening_ = 0;
  Time now_{}, device_clock_{}, ramp_from_{};
  UsbFault fault_ = UsbFault::none;
  bool motors_on_ = false;
};

static_assert(HapticDevice<UsbOmni>);

}  // namespace limpid
