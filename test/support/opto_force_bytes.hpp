// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace limpid::test {

using Bytes = std::vector<std::uint8_t>;

/// `bytes` and their sum in two more, as an OptoForce sensor ends what it sends.
inline Bytes with_checksum(Bytes bytes) {
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  bytes.push_back(static_cast<std::uint8_t>(sum / 256 % 256));
  bytes.push_back(static_cast<std::uint8_t>(sum % 256));
  return bytes;
}

/// A frame as the sensor sends it.
inline Bytes frame_bytes(unsigned number, unsigned status, const std::array<int, 3>& counts) {
  Bytes bytes{0xAA, 7, 8, 10};
  const auto add = [&](unsigned word) {
    bytes.push_back(static_cast<std::uint8_t>(word / 256 % 256));
    bytes.push_back(static_cast<std::uint8_t>(word % 256));
  };
  add(number);
  add(status);
  for (const int count : counts) add(static_cast<unsigned>(count + 65536) % 65536);
  return with_checksum(bytes);
}

/// An answer to a configuration.
inline Bytes answer_bytes(std::uint8_t error) { return with_checksum({0xAA, 0, 0x50, 1, error}); }

/// One after the other.
template <typename... Parts>
Bytes joined(const Parts&... parts) {
  Bytes all;
  (all.insert(all.end(), parts.begin(), parts.end()), ...);
  return all;
}

}  // namespace limpid::test
