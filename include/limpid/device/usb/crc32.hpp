// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace limpid {

/// CRC-32 of IEEE 802.3: polynomial 04C11DB7, reflected, started and ended with all bits inverted; of the nine bytes
/// "123456789" it is CBF43926. Every error of up to 32 bits in a row, and of up to 4 bits anywhere in 64 bytes, changes
/// it.
/// @realtime  no allocation, no throw; a table of 1 kB
[[nodiscard]] constexpr std::uint32_t crc32(std::span<const std::byte> bytes) noexcept {
  constexpr auto table = [] {
    std::array<std::uint32_t, 256> entries{};
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
      std::uint32_t rest = i;
      for (int bit = 0; bit < 8; ++bit) rest = (rest & 1U) != 0 ? rest >> 1U ^ 0xEDB8'8320U : rest >> 1U;
      entries[i] = rest;
    }
    return entries;
  }();
  std::uint32_t crc = ~0U;
  for (const std::byte byte : bytes) crc = crc >> 8U ^ table[(crc ^ std::to_integer<std::uint32_t>(byte)) & 0xFFU];
  return ~crc;
}

}  // namespace limpid
