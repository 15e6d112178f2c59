// SPDX-License-Identifier: MIT
#pragma once

#include <emulator/plain_client.hpp>

#include <string>
#include <utility>
#include <vector>

namespace limpid::emulator {

/// What libusb tells of devices that come and go.
class HotplugLog {
 public:
  explicit HotplugLog(libusb_context* context) : context_{context} {
    libusb_hotplug_register_callback(context, LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT,
                                     LIBUSB_HOTPLUG_ENUMERATE, LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY,
                                     LIBUSB_HOTPLUG_MATCH_ANY, note, this, &handle_);
  }
  ~HotplugLog() { libusb_hotplug_deregister_callback(context_, handle_); }
  HotplugLog(const HotplugLog&) = delete;
  HotplugLog& operator=(const HotplugLog&) = delete;

  /// Whether it is told within 2 s; that and what came before it count no more.
  bool wait_for(libusb_hotplug_event event, const std::string& path) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
    do {
      {
        const std::lock_guard lock(mutex_);
        while (!log_.empty()) {
          const auto first = log_.front();
          log_.pop_front();
          if (first == std::pair{event, path}) return true;
        }
      }
      timeval wait{0, 10'000};
      libusb_handle_events_timeout(context_, &wait);
    } while (std::chrono::steady_clock::now() < end);
    return false;
  }

 private:
  static int LIBUSB_CALL note(libusb_context*, libusb_device* device, libusb_hotplug_event event, void* self) {
    auto& log = *static_cast<HotplugLog*>(self);
    const std::lock_guard lock(log.mutex_);
    log.log_.emplace_back(event, path_of(device));
    return 0;
  }

  libusb_context* context_;
  libusb_hotplug_callback_handle handle_{};
  std::mutex mutex_;
  std::deque<std::pair<libusb_hotplug_event, std::string>> log_;
};

}  // namespace limpid::emulator
