// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace limpid {

/// The unsigned number at `at`, least significant byte first, whatever the machine's order.
/// @realtime  no allocation, no throw; at + sizeof(Number) must lie within the bytes
template <std::unsigned_integral Number>
[[nodiscard]] constexpr Number load_little_endian(std::span<const std::byte> bytes, std::size_t at) noexcept {
  std::uint64_t number = 0;
  for (std::size_t i = sizeof(Number); i-- > 0;) {
    number = number << 8U | std::to_integer<std::uint64_t>(bytes[at + i]);
  }
  return static_cast<Number>(number);
}

/// Writes a number as `load_little_endian` reads it.
template <std::unsigned_integral Number>
constexpr void store_little_endian(std::span<std::byte> bytes, std::size_t at, Number number) noexcept {
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    bytes[at + i] = static_cast<std::byte>(static_cast<std::uint64_t>(number) >> (8 * i));
  }
}

}  // namespace limpid
