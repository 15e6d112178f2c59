// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/time.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace limpid {

/// What an OptoForce OMD sensor of three axes sends, 16 bytes, big endian:
///
///     AA 07 08 0A   number (2)   status (2)   Fx Fy Fz (2 each)   sum of the 14 bytes before (2)
struct OptoForceFrame {
  std::uint16_t number = 0;              ///< counts frames, 65535 is followed by 0
  std::uint16_t status = 0;              ///< as sent
  std::array<std::int16_t, 3> counts{};  ///< Fx, Fy, Fz

  /// What is wrong with sensor or electronics; 0: nothing, and the counts are valid.
  [[nodiscard]] constexpr unsigned errors() const noexcept { return status & 0xFC00U; }
  /// Which axes are beyond their range; 0: none.
  [[nodiscard]] constexpr unsigned overloads() const noexcept { return status & 0x03FFU; }
};

/// What it answers to a configuration, 7 bytes: AA 00 50 01   error   sum of the 5 bytes before (2).
struct OptoForceAnswer {
  std::uint8_t error = 0;  ///< 0: the configuration was taken
};

/// Cut-off of the sensor's own low-pass filter, as it is sent.
enum class OptoForceFilter : std::uint8_t { none, hz_500, hz_150, hz_50, hz_15, hz_5, hz_1_5 };

/// How the sensor shall measure.
struct OptoForceConfiguration {
  Duration period = std::chrono::milliseconds(1);    ///< between frames, 1 to 255 whole milliseconds
  OptoForceFilter filter = OptoForceFilter::hz_150;  ///< adds a delay of about 1/(2 pi f)
  bool zero = false;  ///< what it feels when it takes the configuration becomes its zero; else its zero is the maker's

  /// @throws std::invalid_argument  where the sensor has no such setting
  void check() const {
    using std::chrono::milliseconds;
    expect(period >= milliseconds(1) && period <= milliseconds(255) && period % milliseconds(1) == Duration::zero(),
           "OptoForceConfiguration: period", "1 to 255 whole milliseconds", period);
    expect(filter <= OptoForceFilter::hz_1_5, "OptoForceConfiguration: filter", "one of OptoForceFilter",
           static_cast<int>(filter));
  }
};

/// A configuration as it is sent: AA 00 32 03   period, ms   filter   zero, 255 or 0   sum of the 7 bytes before (2).
/// @throws std::invalid_argument  where the sensor has no such setting
[[nodiscard]] inline std::array<std::uint8_t, 9> encode(const OptoForceConfiguration& configuration) {
  configuration.check();
  std::array<std::uint8_t, 9> bytes{0xAA, 0x00, 0x32, 0x03};
  bytes[4] = static_cast<std::uint8_t>(configuration.period / std::chrono::milliseconds(1));
  bytes[5] = static_cast<std::uint8_t>(configuration.filter);
  bytes[6] = configuration.zero ? 255 : 0;
  unsigned sum = 0;
  for (std::size_t i = 0; i < 7; ++i) sum += bytes[i];
  bytes[7] = static_cast<std::uint8_t>(sum >> 8U);
  bytes[8] = static_cast<std::uint8_t>(sum & 0xFFU);
  return bytes;
}

}  // namespace limpid
