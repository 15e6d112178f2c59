// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/usb/usb_error.hpp>
#include <limpid/device/usb/usb_protocol.hpp>

#include <libusb.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace limpid {

namespace detail {

struct UsbExit {
  void operator()(libusb_context* context) const noexcept { libusb_exit(context); }
};
struct UsbClose {
  void operator()(libusb_device_handle* handle) const noexcept { libusb_close(handle); }
};

}  // namespace detail

using UsbContext = std::unique_ptr<libusb_context, detail::UsbExit>;

/// @throws UsbError
[[nodiscard]] inline UsbContext make_usb_context() {
  libusb_context* context = nullptr;
  if (const int code = libusb_init(&context); code != LIBUSB_SUCCESS) {
    throw UsbError(UsbFailure::system, std::string("libusb: expected to start, got ") + libusb_strerror(code));
  }
  return UsbContext(context);
}

/// A device that is plugged in.
struct UsbPresence {
  UsbIdentity identity;
  std::string path;  ///< bus and ports, "1-2.4", as the kernel names it
  std::shared_ptr<libusb_device> device;
};

/// "1209:0001".
[[nodiscard]] inline std::string describe(const UsbIdentity& identity) {
  std::string text;
  for (const std::uint16_t number : {identity.vendor, identity.product}) {
    for (unsigned place = 4; place-- > 0;) text += "0123456789abcdef"[number >> (4 * place) & 0xFU];
    if (text.size() == 4) text += ':';
  }
  return text;
}

/// What is plugged in now, without opening anything.
/// @throws UsbError
[[nodiscard]] inline std::vector<UsbPresence> list_usb_devices(libusb_context* context) {
  libusb_device** list = nullptr;
  const auto count = libusb_get_device_list(context, &list);
  if (count < 0) {
    throw UsbError(UsbFailure::system,
                   std::string("libusb: expected a list of devices, got ") + libusb_strerror(static_cast<int>(count)));
  }
  std::vector<UsbPresence> present;
  for (auto* device : std::span(list, static_cast<std::size_t>(count))) {
    libusb_device_descriptor descriptor{};
    if (libusb_get_device_descriptor(device, &descriptor) != LIBUSB_SUCCESS) continue;
    std::array<std::uint8_t, 7> ports{};
    const int depth = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
    std::string path = std::to_string(libusb_get_bus_number(device));
    for (int i = 0; i < depth; ++i) {
      path += (i == 0 ? '-' : '.') + std::to_string(ports[static_cast<std::size_t>(i)]);
    }
    present.push_back({{descriptor.idVendor, descriptor.idProduct},
                       std::move(path),
                       std::shared_ptr<libusb_device>(libusb_ref_device(device), libusb_unref_device)});
  }
  libusb_free_device_list(list, 1);
  return present;
}

/// The 3D Systems Touch family, whose protocol on USB nobody has described.
[[nodiscard]] inline bool is_touch(const UsbIdentity& identity) noexcept {
  constexpr std::array touch{UsbIdentity{0x0301, 0x2988}, UsbIdentity{0x2988, 0x0302}, UsbIdentity{0x2988, 0x0304}};
  return std::find(touch.begin(), touch.end(), identity) != touch.end();
}

/// Whether a device that was listed has gone away since: libusb hears of it from udev, later or never.
[[nodiscard]] inline bool has_gone(const UsbPresence& listed) noexcept {
  libusb_device_handle* handle = nullptr;
  const int code = libusb_open(listed.device.get(), &handle);
  if (code == LIBUSB_SUCCESS) libusb_close(handle);
  return code == LIBUSB_ERROR_NO_DEVICE;
}

/// The one device of these identities, or the one of them at `path`.
/// @throws UsbError  not_found, several, refused
[[nodiscard]] inline UsbPresence choose_usb_device(const std::vector<UsbPresence>& present,
                                                   std::span<const UsbIdentity> identities, const std::string& path) {
  std::string wanted, there;
  for (const UsbIdentity& identity : identities) wanted += (wanted.empty() ? "" : " or ") + describe(identity);
  if (!path.empty()) wanted += " at " + path;
  std::vector<UsbPresence> fitting;
  const UsbPresence* touch = nullptr;
  for (const UsbPresence& each : present) {
    if (is_touch(each.identity)) touch = &each;
    if (std::find(identities.begin(), identities.end(), each.identity) == identities.end()) continue;
    there += (there.empty() ? "" : ", ") + each.path;
    if (path.empty() || each.path == path) fitting.push_back(each);
  }
  if (fitting.size() > 1) std::erase_if(fitting, has_gone);
  if (fitting.size() == 1) return fitting.front();
  if (fitting.size() > 1) {
    throw UsbError(UsbFailure::several,
                   "UsbLink: path: expected one of " + there + " to be named, got none: each is a " + wanted);
  }
  if (touch != nullptr) {
    throw UsbError(UsbFailure::refused, "UsbLink: expected a device " + wanted + ", got a 3D Systems Touch (" +
                                            describe(touch->identity) + " at " + touch->path +
                                            "): the vendor's USB protocol is not documented");
  }
  throw UsbError(UsbFailure::not_found, "UsbLink: expected a device " + wanted + " to be plugged in, got " +
                                            (there.empty() ? "none" : "one at " + there));
}

/// An opened device with its interface claimed, until it is destroyed.
class UsbHandle {
 public:
  /// @throws UsbError  permission, busy, system
  UsbHandle(const UsbPresence& present, int interface_number) : path_{present.path}, interface_{interface_number} {
    const std::string who = "UsbLink: device " + path_ + " (" + describe(present.identity) + ")";
    libusb_device_handle* handle = nullptr;
    check(who, "open it", libusb_open(present.device.get(), &handle));
    handle_.reset(handle);
    (void)libusb_set_auto_detach_kernel_driver(handle, 1);
    check(who, "claim its interface", libusb_claim_interface(handle, interface_));
  }
  ~UsbHandle() {
    if (handle_) (void)libusb_release_interface(handle_.get(), interface_);
  }
  UsbHandle(const UsbHandle&) = delete;
  UsbHandle& operator=(const UsbHandle&) = delete;
  UsbHandle(UsbHandle&&) = delete;
  UsbHandle& operator=(UsbHandle&&) = delete;

  [[nodiscard]] libusb_device_handle* get() const noexcept { return handle_.get(); }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

  /// Sends what the device needs once. Waits up to a second for each.
  /// @throws UsbError
  void prepare(std::span<const UsbControl> controls) const {
    for (const UsbControl& control : controls) {
      const int code = libusb_control_transfer(handle_.get(), control.type, control.request, control.value,
                                               control.index, nullptr, 0, 1000);
      if (code < 0) check("UsbLink: device " + path_, "prepare it", code);
    }
  }

 private:
  static void check(const std::string& who, const std::string& action, int code) {
    if (code == LIBUSB_SUCCESS) return;
    if (code == LIBUSB_ERROR_ACCESS) {
      throw UsbError(UsbFailure::permission,
                     who + ": expected the permission to " + action +
                         ", got none: copy 60-limpid-usb.rules to /etc/udev/rules.d, run `udevadm control --reload`, "
                         "and plug the device again");
    }
    const UsbFailure failure = code == LIBUSB_ERROR_BUSY ? UsbFailure::busy : UsbFailure::system;
    throw UsbError(failure, who + ": expected to " + action + ", got " + libusb_strerror(code));
  }

  std::string path_;
  int interface_;
  std::unique_ptr<libusb_device_handle, detail::UsbClose> handle_;
};

}  // namespace limpid
