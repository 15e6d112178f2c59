// SPDX-License-Identifier: MIT
#include "usb_words.hpp"

#include <limpid/device/usb/falcon.hpp>
#include <limpid/device/usb/omni_bridge.hpp>

#include <algorithm>
#include <sstream>

namespace limpid::examples {

namespace {

bool is_one_of(const UsbIdentity& identity, std::span<const UsbIdentity> known) {
  return std::find(known.begin(), known.end(), identity) != known.end();
}

}  // namespace

std::string known_device(const UsbIdentity& identity, std::span<const UsbIdentity> omnis) {
  if (is_one_of(identity, omnis) || is_one_of(identity, OmniBridge::identities)) return "Omni behind a bridge board";
  if (is_one_of(identity, Falcon::identities)) return "Novint Falcon; its firmware must be loaded by other means first";
  if (is_touch(identity)) return "3D Systems Touch: not served, the vendor's USB protocol is not documented";
  return {};
}

std::string known_devices(const std::vector<UsbPresence>& present, std::span<const UsbIdentity> omnis) {
  std::string text;
  for (const UsbPresence& each : present) {
    const std::string what = known_device(each.identity, omnis);
    if (!what.empty()) text += "  " + each.path + "  " + limpid::describe(each.identity) + "  " + what + '\n';
  }
  if (text.empty()) text = "  nothing that limpid knows\n";
  return text;
}

std::string describe(const UsbCounters& counters) {
  std::ostringstream text;
  text << "states " << counters[UsbCount::states] << ", lost " << counters[UsbCount::lost] << ", repeated "
       << counters[UsbCount::repeated] << ", damaged " << counters[UsbCount::damaged] << ", transfers failed "
       << counters[UsbCount::in_errors] << " in, " << counters[UsbCount::out_errors] << " out\n"
       << "commands " << counters[UsbCount::commands] << ", dropped " << counters[UsbCount::dropped]
       << ", halts cleared " << counters[UsbCount::halts] << ", disconnects " << counters[UsbCount::disconnects]
       << ", faults " << counters[UsbCount::faults] << '\n';
  return text.str();
}

}  // namespace limpid::examples
