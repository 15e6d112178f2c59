// SPDX-License-Identifier: MIT
#pragma once

#include "usb_settings.hpp"
#include "usbfs.hpp"

#include <umockdev.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace limpid::emulator {

/// A machine's USB as libusb sees it, in place of the real one: /sys, /dev and udev's messages, by umockdev. One at a
/// time in a process. It holds for this process, linked with libumockdev-preload, and for children that preload it.
///
/// umockdev sleeps for 0 s after each ioctl, which the kernel makes 50 us: the thread that makes the bus, and those
/// that it starts later, are woken without that slack.
class EmulatedBus {
 public:
  /// @throws std::runtime_error  where the process has no libumockdev-preload before libc
  EmulatedBus();

  /// A device that is plugged in; it is unplugged with its end.
  class Plugged {
   public:
    Plugged(EmulatedBus& bus, const UsbSettings& settings);
    ~Plugged();
    Plugged(const Plugged&) = delete;
    Plugged& operator=(const Plugged&) = delete;

    [[nodiscard]] const std::shared_ptr<Usbfs>& usbfs() const { return usbfs_; }
    [[nodiscard]] unsigned number() const { return number_; }  ///< devnum, another with each plug

   private:
    EmulatedBus& bus_;
    unsigned number_;
    std::string node_;   // /dev/bus/usb/...
    std::string sysfs_;  // /sys/devices/...
    std::shared_ptr<Usbfs> usbfs_;
    std::shared_ptr<UMockdevIoctlBase> server_;
  };

  [[nodiscard]] const std::string& root() const { return root_; }  ///< UMOCKDEV_DIR

 private:
  std::string add_to_sysfs(const UsbSettings& settings, unsigned number, const char* parent);
  const std::string& hub(unsigned bus);

  std::recursive_mutex mutex_;  // of all but root_
  std::shared_ptr<UMockdevTestbed> testbed_;
  std::string root_;
  std::map<unsigned, std::string> hubs_;  // by bus
  std::map<unsigned, unsigned> next_;     // devnum, by bus
};

}  // namespace limpid::emulator
