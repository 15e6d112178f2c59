// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace limpid {

/// Why a device on USB could not be used.
enum class UsbFailure {
  not_found,   ///< no device of the protocol is there
  several,     ///< more than one is, and none was named
  refused,     ///< one is there that limpid does not serve
  permission,  ///< the user may not open it
  busy,        ///< another program or a driver has it
  system,      ///< libusb or the device said no
};

/// What the constructors of devices on USB throw; the message names what was looked for, and what to do about it.
class UsbError : public std::runtime_error {
 public:
  UsbError(UsbFailure failure, const std::string& what) : std::runtime_error(what), failure_{failure} {}

  [[nodiscard]] UsbFailure failure() const noexcept { return failure_; }

 private:
  UsbFailure failure_;
};

}  // namespace limpid
