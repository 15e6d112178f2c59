// SPDX-License-Identifier: MIT
#include "usb_omni_options.hpp"

#include "omni_calibration_file.hpp"
#include "option_checks.hpp"
#include "option_values.hpp"

#include <charconv>
#include <stdexcept>

namespace limpid::examples {

UsbOmni::Settings UsbOmniOptions::settings() const {
  if (calibration.empty()) {
    throw std::invalid_argument(
        "--calibration: expected a file with the measured torque scale, which has no default, "
        "got none");
  }
  return {.calibration = read_omni_calibration(calibration), .link = link};
}

UsbOmni::Settings UsbOmniOptions::reading_only() const {
  if (!calibration.empty()) return settings();
  UsbOmni::Settings settings;
  settings.link = link;
  settings.calibration.full_scale.setOnes();  // of a torque that is never written
  return settings;
}

void add_usb_omni_options(CLI::App& app, UsbOmniOptions& options) {
  app.add_option("--path", options.link.path, "Where the Omni is plugged in, 1-2.4, where there is more than one");
  const auto add_identity = [&options](const std::string& typed) {
    const auto identity = usb_identity_of(typed);
    if (!identity) refuse("--id", "a USB vendor and product in hexadecimal, as 1209:0001", typed);
    options.link.identities = {*identity};
  };
  app.add_option_function<std::string>("--id", add_identity,
                                       "USB vendor and product of the bridge board; that of pid.codes's tests without")
      ->type_name("VVVV:PPPP");
  const auto set_watchdog = [&options](double milliseconds) { set_watchdogs(options.link, milliseconds); };
  app.add_option_function<double>("--watchdog", set_watchdog,
                                  "ms without commands or states after which the motors go off; 20 without")
      ->check(within(4, 1000));
  app.add_option("--calibration", options.calibration, "Its calibration, JSON")->type_name("FILE");
}

void set_watchdogs(UsbLinkSettings& link, double milliseconds) {
  link.device_watchdog = link.host_watchdog = from_seconds(1e-3 * milliseconds);
  link.stale_after = link.host_watchdog / 2;
}

std::optional<UsbIdentity> usb_identity_of(const std::string& text) {
  if (text.size() != 9 || text[4] != ':') return std::nullopt;
  const auto number = [](const char* at, std::uint16_t& value) {
    const auto [end, error] = std::from_chars(at, at + 4, value, 16);
    return error == std::errc{} && end == at + 4;
  };
  UsbIdentity identity{};
  if (!number(text.data(), identity.vendor) || !number(text.data() + 5, identity.product)) return std::nullopt;
  return identity;
}

}  // namespace limpid::examples
