// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace limpid::emulator {

using Bytes = std::vector<std::uint8_t>;

/// An endpoint's descriptor.
struct UsbEndpoint {
  std::uint8_t address;         ///< 0x80 and its number for IN
  std::uint8_t attributes = 3;  ///< 2 bulk, 3 interrupt
  std::uint16_t packet = 64;    ///< most bytes at once
  std::uint8_t interval = 1;    ///< of an interrupt endpoint, ms
};

struct UsbInterface {
  std::uint8_t device_class = 0xff;
  std::vector<UsbEndpoint> endpoints;
  std::string driver{};  ///< of the kernel, that has it; none where empty
};

/// A full-speed device with one configuration, as it is plugged in.
struct UsbSettings {
  std::string path = "1-1";  ///< bus-port[.port...], its name in sysfs
  std::uint16_t vendor = 0x1209;
  std::uint16_t product = 0x0001;
  std::uint16_t release = 0x0100;
  std::uint8_t device_class = 0;
  std::string maker = "limpid";
  std::string name = "emulated device";
  std::string serial = "1";
  std::vector<UsbInterface> interfaces{};
  unsigned mode = 0666;  ///< of the device node

  [[nodiscard]] unsigned bus() const { return static_cast<unsigned>(std::stoul(path)); }
};

[[nodiscard]] constexpr bool is_in(std::uint8_t endpoint) { return (endpoint & 0x80U) != 0; }

}  // namespace limpid::emulator
