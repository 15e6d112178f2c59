// SPDX-License-Identifier: MIT
// The Omni on USB; without libusb at build time only a sentence.
#include "live_device.hpp"

#ifdef LIMPID_EXAMPLES_WITH_USB

#include <limpid/device/arm_hardware.hpp>
#include <limpid/device/usb/usb_omni.hpp>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <thread>

namespace limpid::examples {

namespace {

using namespace std::chrono_literals;

UsbOmni::Settings settings_of(const LiveSettings& live) {
  UsbOmni::Settings settings;
  settings.calibration = live.calibration;
  settings.link.path = live.usb_path;
  settings.link.priority = live.priority;  // as the loop's: it waits for what this brings
  settings.ramp = 100ms;
  settings.rate_filter = ArmHardware<3>{}.rate_filter;  // that of the controller's gains (5.6), and of the simulation
  return settings;
}

class UsbLive : public LiveDevice {
 public:
  explicit UsbLive(const LiveSettings& live) : omni_(settings_of(live)) {}

  void prepare(const std::stop_token& stop) override {
    wait(stop, "put the stylus into its dock", [&] { return omni_.calibrated(); });
    wait(stop, "draw the stylus out, hold it still where the wall is to be", [&] {
      if (omni_.docked() || joints_.qdot.norm() > 0.05) moved_at_ = steady_now();  // rad/s
      return steady_now() - moved_at_ > 500ms;
    });
    well_since_ = steady_now();
  }

  // Half a tick beside the mean, on the circle of a tick, of when the last states came.
  [[nodiscard]] std::optional<Time> grid(Duration tick) const override {
    const double turn = 2 * std::numbers::pi / in_seconds(tick);
    double x = 0, y = 0;
    for (const Time stamp : stamps_) {
      const double angle = turn * in_seconds(stamp % tick);
      x += std::cos(angle);
      y += std::sin(angle);
    }
    return from_seconds(std::atan2(y, x) / turn) + tick / 2;
  }

  // Motors off, until the first tick; once it has been without a fault for as long as a link needs to find one.
  bool settle(Time now) noexcept override {
    joints_ = omni_.read(now).joint_state();
    if (omni_.fault() == UsbFault::stale) {
      omni_.clear_fault();
      well_since_ = now;
    }
    if (omni_.fault() != UsbFault::none) return true;  // any other ends the run in its first tick
    began_ = now;
    last_count_ = omni_.states();
    return now - well_since_ > 50ms;
  }

  DeviceState<> read(Time now, const Eigen::Vector3d&) noexcept override {
    const Time begin = steady_now();
    DeviceState<> seen = omni_.read(now);
    call_ = steady_now() - begin;
    const std::uint64_t count = omni_.states();
    used_ += count > last_count_ ? 1 : 0;
    came_ += count - last_count_;
    last_count_ = count;
    joints_ = seen.joint_state();
    seen.status |= when(!omni_.calibrated() || omni_.docked(), Status::fault);  // angles or motors that are not there
    return seen;
  }

  Status write(const SafeTorque<3>& torque) noexcept override {
    const Time begin = steady_now();
    const Status status = omni_.write(torque);
    report_.calls.add(call_ + (steady_now() - begin));
    ended_ = steady_now();
    return status;
  }

  [[nodiscard]] JointState<3> joints() const noexcept override { return joints_; }

  [[nodiscard]] LiveDeviceReport report() const override {
    LiveDeviceReport report = report_;
    const UsbCounters& counters = omni_.counters();
    report.states_per_second = static_cast<double>(came_) / in_seconds(ended_ - began_);
    report.used_in_their_tick = came_ > 0 ? static_cast<double>(used_) / static_cast<double>(came_) : 0;
    report.lost = counters[UsbCount::lost];
    report.damaged = counters[UsbCount::damaged];
    report.commands = counters[UsbCount::commands];
    report.dropped = counters[UsbCount::dropped];
    if (omni_.fault() != UsbFault::none) report.fault = describe(omni_.fault());
    return report;
  }

 private:
  // Without a command of the loop the motors are off.
  template <typename Condition>
  void wait(const std::stop_token& stop, const std::string& what_for, Condition&& condition) {
    bool said = false;
    while (!stop.stop_requested()) {
      const DeviceState<> seen = omni_.read(steady_now());
      joints_ = seen.joint_state();
      stamps_[next_stamp_++ % stamps_.size()] = seen.stamp;
      if (condition()) return;
      if (!said && omni_.states() > 0) std::cerr << "waiting: " << what_for << '\n';
      said = said || omni_.states() > 0;
      if (omni_.fault() == UsbFault::stale) omni_.clear_fault();
      if (omni_.fault() != UsbFault::none)
        throw std::runtime_error("--device usb: " + std::string(describe(omni_.fault())));
      std::this_thread::sleep_for(1ms);
    }
  }

  UsbOmni omni_;
  LiveDeviceReport report_{};
  JointState<3> joints_{};
  std::array<Time, 64> stamps_{};  // of the last states, while it waited
  std::size_t next_stamp_ = 0;
  Duration call_{};
  Time moved_at_{steady_now()}, well_since_{}, began_{}, ended_{};
  std::uint64_t last_count_ = 0, used_ = 0, came_ = 0;
};

}  // namespace

std::unique_ptr<LiveDevice> make_usb_device(const LiveSettings& settings) {
  return std::make_unique<UsbLive>(settings);
}

}  // namespace limpid::examples

#else

#include <stdexcept>

namespace limpid::examples {

std::unique_ptr<LiveDevice> make_usb_device(const LiveSettings&) {
  throw std::runtime_error("--device usb: needs libusb-1.0, which was not there when this was built");
}

}  // namespace limpid::examples

#endif
