// SPDX-License-Identifier: MIT
#include "usb_descriptors.hpp"

#include <cstddef>

namespace limpid::emulator {
namespace {

constexpr std::uint8_t device_type = 1, configuration_type = 2, string_type = 3, interface_type = 4, endpoint_type = 5;

std::uint8_t low(std::size_t value) { return static_cast<std::uint8_t>(value & 0xffU); }
std::uint8_t high(std::size_t value) { return static_cast<std::uint8_t>((value >> 8U) & 0xffU); }

void append(Bytes& to, const Bytes& more) { to.insert(to.end(), more.begin(), more.end()); }

Bytes string_descriptor(const std::string& text) {
  Bytes bytes{low(2 + 2 * text.size()), string_type};
  for (const char letter : text) append(bytes, {static_cast<std::uint8_t>(letter), 0});
  return bytes;
}

std::optional<Bytes> descriptor(const UsbSettings& device, std::uint8_t type, std::uint8_t index) {
  if (type == device_type) return device_descriptor(device);
  if (type == configuration_type && index == 0) return configuration_descriptor(device);
  if (type != string_type) return std::nullopt;
  switch (index) {
    case 0:
      return Bytes{4, string_type, 0x09, 0x04};  // English
    case 1:
      return string_descriptor(device.maker);
    case 2:
      return string_descriptor(device.name);
    case 3:
      return string_descriptor(device.serial);
    default:
      return std::nullopt;
  }
}

}  // namespace

Bytes device_descriptor(const UsbSettings& device) {
  return {18,
          device_type,
          0x00,
          0x02,
          device.device_class,
          0,
          0,
          64,
          low(device.vendor),
          high(device.vendor),
          low(device.product),
          high(device.product),
          low(device.release),
          high(device.release),
          1,
          2,
          3,
          1};
}

Bytes configuration_descriptor(const UsbSettings& device) {
  Bytes rest;
  for (std::size_t i = 0; i < device.interfaces.size(); ++i) {
    const UsbInterface& interface = device.interfaces[i];
    append(rest, {9, interface_type, low(i), 0, low(interface.endpoints.size()), interface.device_class, 0, 0, 0});
    for (const UsbEndpoint& end : interface.endpoints)
      append(rest, {7, endpoint_type, end.address, end.attributes, low(end.packet), high(end.packet), end.interval});
  }
  const std::size_t length = 9 + rest.size();
  Bytes bytes{9, configuration_type, low(length), high(length), low(device.interfaces.size()), 1, 0, 0x80, 50};
  append(bytes, rest);
  return bytes;
}

std::optional<Bytes> answer_control(const UsbSettings& device, std::span<const std::uint8_t> setup) {
  if (setup.size() < 8 || (setup[0] & 0x60U) != 0) return std::nullopt;  // no requests of a class or maker
  const std::size_t most = setup[6] + 256U * setup[7];
  std::optional<Bytes> answer;
  switch (setup[1]) {
    case 0x00:  // GET_STATUS
      answer = Bytes{0, 0};
      break;
    case 0x06:  // GET_DESCRIPTOR
      answer = descriptor(device, setup[3], setup[2]);
      break;
    case 0x08:  // GET_CONFIGURATION
      answer = Bytes{1};
      break;
    default:
      break;
  }
  if (answer && answer->size() > most) answer->resize(most);
  return answer;
}

}  // namespace limpid::emulator
