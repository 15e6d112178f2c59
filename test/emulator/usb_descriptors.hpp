// SPDX-License-Identifier: MIT
#pragma once

#include "usb_settings.hpp"

#include <optional>
#include <span>

namespace limpid::emulator {

/// Chapter 9 of the USB specification, as far as a host asks.
[[nodiscard]] Bytes device_descriptor(const UsbSettings& device);
[[nodiscard]] Bytes configuration_descriptor(const UsbSettings& device);

/// The answer to a standard request of 8 bytes on endpoint 0; nothing is a stall.
[[nodiscard]] std::optional<Bytes> answer_control(const UsbSettings& device, std::span<const std::uint8_t> setup);

}  // namespace limpid::emulator
