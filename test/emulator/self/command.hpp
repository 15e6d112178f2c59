// SPDX-License-Identifier: MIT
#pragma once

#include <emulator/omni_wire.hpp>

namespace limpid::emulator {

/// A command as a host sends it.
inline Bytes command(std::uint32_t sequence, const std::array<std::uint16_t, 3>& dac, bool motors_on,
                     std::uint16_t watchdog) {
  const auto low = [](std::uint32_t word) { return static_cast<std::uint8_t>(word & 0xffU); };
  const std::uint16_t status = motors_on ? 0x53c8 : 0x53c0;
  Bytes bytes{'L', 'O', 1, 'C'};
  for (unsigned shift = 0; shift < 32; shift += 8) bytes.push_back(low(sequence >> shift));
  for (const std::uint16_t word : {watchdog, std::uint16_t{0}, dac[0], dac[1], dac[2], status}) {
    bytes.push_back(low(word));
    bytes.push_back(low(word >> 8U));
  }
  bytes.resize(32);
  seal(bytes);
  return bytes;
}

}  // namespace limpid::emulator
