// SPDX-License-Identifier: MIT
#pragma once

#include "emulated_omni.hpp"

#include <cstdlib>
#include <optional>
#include <string>

namespace limpid::emulator {

/// NAME[:FRAMES]@SECONDS: a fault, or what else happens to an emulated Omni, at a time of the run.
struct TimedEvent {
  std::string name;
  int frames = OmniFaults::always;
  double at = 0;  ///< s

  static std::string expected() {
    std::string names;
    for (const auto name : fault_names) names += std::string(name) + ' ';
    return "NAME[:FRAMES]@SECONDS, with a NAME of " + names + "clear unplug plug plug-home reboot dock undock";
  }

  static std::optional<TimedEvent> parse(const std::string& text) {
    const auto at = text.find('@');
    if (at == std::string::npos) return std::nullopt;
    const auto colon = text.find(':');
    TimedEvent event{.name = text.substr(0, std::min(at, colon))};
    char* end = nullptr;
    event.at = std::strtod(text.c_str() + at + 1, &end);
    if (*end != '\0' || end == text.c_str() + at + 1) return std::nullopt;
    if (colon < at) event.frames = std::atoi(text.c_str() + colon + 1);
    if (event.frames == 0 || (!fault_named(event.name) && !is_action(event.name))) return std::nullopt;
    return event;
  }

  void apply(EmulatedOmni& omni) const {
    if (const auto fault = fault_named(name)) omni.set(*fault, frames);
    if (name == "clear") omni.clear_faults();
    if (name == "unplug") omni.unplug();
    if (name == "plug") omni.plug();
    if (name == "plug-home") omni.plug(std::nullopt, true);
    if (name == "reboot") omni.reboot();
    if (name == "dock" || name == "undock") omni.set_docked(name == "dock");
  }

 private:
  static bool is_action(const std::string& name) {
    for (const char* one : {"clear", "unplug", "plug", "plug-home", "reboot", "dock", "undock"})
      if (name == one) return true;
    return false;
  }
};

}  // namespace limpid::emulator
