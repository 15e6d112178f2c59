# SPDX-License-Identifier: MIT
# limpid::usb, what device/usb/ needs: limpid and libusb-1.0, where pkg-config finds it.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(LIMPID_LIBUSB QUIET IMPORTED_TARGET GLOBAL libusb-1.0)
endif()
if(TARGET PkgConfig::LIMPID_LIBUSB)
  add_library(limpid_usb INTERFACE)
  add_library(limpid::usb ALIAS limpid_usb)
  target_link_libraries(limpid_usb INTERFACE limpid::limpid PkgConfig::LIMPID_LIBUSB)
else()
  message(STATUS "limpid: libusb-1.0 was not found by pkg-config: no device on USB, all else is built")
endif()
