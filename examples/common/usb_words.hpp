// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/usb/usb_counters.hpp>
#include <limpid/device/usb/usb_device.hpp>

#include <span>
#include <string>
#include <vector>

namespace limpid::examples {

/// What limpid knows of a device by its number, and whether it serves it; empty where it knows nothing.
/// @param omnis  numbers of Omnis besides OmniBridge's own
[[nodiscard]] std::string known_device(const UsbIdentity& identity, std::span<const UsbIdentity> omnis);

/// A line for each of them that limpid knows; one that says so where it knows none.
[[nodiscard]] std::string known_devices(const std::vector<UsbPresence>& present, std::span<const UsbIdentity> omnis);

/// What a link has counted, in a few lines.
[[nodiscard]] std::string describe(const UsbCounters& counters);

}  // namespace limpid::examples
