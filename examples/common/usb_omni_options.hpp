// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/usb/usb_omni.hpp>

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace limpid::examples {

/// Which Omni on USB, and its calibration.
struct UsbOmniOptions {
  UsbLinkSettings link{};
  std::string calibration;  ///< path; empty: none

  /// Of an Omni whose motors get torque.
  /// @throws std::invalid_argument  where there is no calibration, or it cannot serve
  [[nodiscard]] UsbOmni::Settings settings() const;

  /// Of an Omni that is only read and never written to. Without a calibration its joints are those of the defaults.
  /// @throws std::invalid_argument  where the calibration cannot serve
  [[nodiscard]] UsbOmni::Settings reading_only() const;
};

/// --path, --id, --calibration, --watchdog
void add_usb_omni_options(CLI::App& app, UsbOmniOptions& options);

/// How long the loop, and half of it how long the device, may be silent before the motors go off; 4 to 1000 ms.
void set_watchdogs(UsbLinkSettings& link, double milliseconds);

/// "1209:0001"; nothing where it is none.
[[nodiscard]] std::optional<UsbIdentity> usb_identity_of(const std::string& text);

}  // namespace limpid::examples
