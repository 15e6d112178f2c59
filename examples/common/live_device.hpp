// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <limpid/control/safe_torque.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/haptic_device.hpp>
#include <limpid/robot/joint_state.hpp>

#include <memory>
#include <optional>
#include <stop_token>

namespace limpid::examples {

/// The arm of a live run, simulated or on USB.
class LiveDevice {
 public:
  LiveDevice() = default;
  virtual ~LiveDevice() = default;
  LiveDevice(const LiveDevice&) = delete;
  LiveDevice& operator=(const LiveDevice&) = delete;

  /// Waits until its joints are known and its motors may be on, and says what for; ends where a stop is requested.
  virtual void prepare(const std::stop_token& stop) = 0;
  /// An instant from which on, a tick apart, the loop best runs: between the device's states, where it has a clock of
  /// its own. Known once prepared.
  [[nodiscard]] virtual std::optional<Time> grid(Duration tick) const = 0;
  /// By the loop, before its first tick, until it returns true: no torque, and what came up while the loop was made is
  /// cleared.
  virtual bool settle(Time now) noexcept = 0;
  /// @param now   by `steady_now`
  /// @param hand  the operator's force on the tip, N: only a simulated arm has to be told
  virtual DeviceState<> read(Time now, const Eigen::Vector3d& hand) noexcept = 0;
  virtual Status write(const SafeTorque<3>& torque) noexcept = 0;
  /// Where the joints are, as well as it is known.
  [[nodiscard]] virtual JointState<3> joints() const noexcept = 0;
  [[nodiscard]] virtual LiveDeviceReport report() const = 0;
};

/// @throws std::runtime_error  where there is no device that can be used, or libusb was not there at build time
[[nodiscard]] std::unique_ptr<LiveDevice> make_live_device(const Scene& scene);

/// A device on USB.
[[nodiscard]] std::unique_ptr<LiveDevice> make_usb_device(const LiveSettings& settings);

}  // namespace limpid::examples
