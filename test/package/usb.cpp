// SPDX-License-Identifier: MIT
#include <limpid/device/usb/usb_omni.hpp>

#include <exception>
#include <iostream>

int main() {
  try {
    const limpid::UsbOmni omni({.calibration = {.full_scale = {0.4, 0.4, 0.2}}});
    std::cout << (omni.docked() ? "docked\n" : "not docked\n");
  } catch (const std::exception& error) {
    std::cout << error.what() << '\n';
  }
}
