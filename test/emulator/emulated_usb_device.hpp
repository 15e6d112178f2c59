// SPDX-License-Identifier: MIT
#pragma once

#include "emulated_bus.hpp"

#include <memory>
#include <mutex>
#include <optional>

namespace limpid::emulator {

/// A device that can be plugged into a bus and out again. Thread-safe. Unplugged, it sends and receives nothing.
class EmulatedUsbDevice {
 public:
  EmulatedUsbDevice(EmulatedBus& bus, UsbSettings settings, bool plugged = true)
      : bus_{bus}, settings_{std::move(settings)} {
    if (plugged) plug();
  }

  /// Appears at `path`, or where it was last, with a new devnum.
  void plug(const std::optional<std::string>& path = std::nullopt) {
    const std::lock_guard lock(mutex_);
    if (plugged_) return;
    if (path) settings_.path = *path;
    plugged_.emplace(bus_, settings_);
    set_usbfs(plugged_->usbfs());
  }

  void unplug() {
    const std::lock_guard lock(mutex_);
    set_usbfs(nullptr);
    plugged_.reset();
  }

  [[nodiscard]] bool plugged() const { return usbfs() != nullptr; }
  /// Of the plug that lasts; null where there is none.
  [[nodiscard]] std::shared_ptr<Usbfs> usbfs() const {
    const std::lock_guard lock(pointer_mutex_);
    return usbfs_;
  }

 private:
  void set_usbfs(std::shared_ptr<Usbfs> usbfs) {
    const std::lock_guard lock(pointer_mutex_);
    usbfs_ = std::move(usbfs);
  }

  EmulatedBus& bus_;
  std::mutex mutex_;  // of plugging, which takes milliseconds
  UsbSettings settings_;
  std::optional<EmulatedBus::Plugged> plugged_{};
  mutable std::mutex pointer_mutex_;
  std::shared_ptr<Usbfs> usbfs_{};
};

}  // namespace limpid::emulator
