// SPDX-License-Identifier: MIT
// Any bytes as a recorded press: refused with a reason, or a force that is finite at any time.
#include <limpid/device/recording.hpp>

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream text(std::string(reinterpret_cast<const char*>(data), size));
  try {
    const auto recording = limpid::Recording::parse(text, "fuzz.csv", {.scale = 2});
    const limpid::Duration whole = recording.duration();
    for (const limpid::Time time : {-whole, limpid::Time{0}, whole / 3, whole / 2, whole, limpid::Time::max()}) {
      if (!std::isfinite(recording.at(time))) __builtin_trap();
    }
  } catch (const std::runtime_error&) {
  }
  return 0;
}
