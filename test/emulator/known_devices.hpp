// SPDX-License-Identifier: MIT
#pragma once

#include "usb_settings.hpp"

namespace limpid::emulator {

/// Devices that are known by their ids alone; what they say is not emulated.

/// 3D Systems Touch Stylus: CDC-ACM, which the kernel's driver has.
inline UsbSettings touch_stylus(const std::string& path = "1-1") {
  const UsbInterface control{.device_class = 2, .endpoints = {{.address = 0x82, .packet = 8}}, .driver = "cdc_acm"};
  const UsbInterface data{.device_class = 10,
                          .endpoints = {{.address = 0x81, .attributes = 2}, {.address = 0x01, .attributes = 2}},
                          .driver = "cdc_acm"};
  return {.path = path,
          .vendor = 0x0301,
          .product = 0x2988,
          .device_class = 2,
          .maker = "3D Systems",
          .name = "Touch Stylus",
          .interfaces = {control, data}};
}

/// Touch USB: CDC-ACM too.
inline UsbSettings touch_usb(const std::string& path = "1-1") {
  UsbSettings settings = touch_stylus(path);
  settings.vendor = 0x2988;
  settings.product = 0x0302;
  settings.name = "Touch USB";
  return settings;
}

/// Touch HID.
inline UsbSettings touch_hid(const std::string& path = "1-1") {
  return {.path = path,
          .vendor = 0x2988,
          .product = 0x0304,
          .maker = "3D Systems",
          .name = "Touch HID",
          .interfaces = {{.device_class = 3, .endpoints = {{.address = 0x81}, {.address = 0x01}}, .driver = "usbhid"}}};
}

/// Novint Falcon, on an FTDI chip.
inline UsbSettings falcon(const std::string& path = "1-1") {
  return {.path = path,
          .vendor = 0x0403,
          .product = 0xcb48,
          .maker = "Novint",
          .name = "Falcon",
          .interfaces = {{.endpoints = {{.address = 0x81, .attributes = 2}, {.address = 0x02, .attributes = 2}}}}};
}

}  // namespace limpid::emulator
