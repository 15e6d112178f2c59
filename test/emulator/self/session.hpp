// SPDX-License-Identifier: MIT
#pragma once

#include "command.hpp"

#include <emulator/emulated_omni.hpp>
#include <emulator/plain_client.hpp>

#include <doctest/doctest.h>

#include <functional>
#include <optional>

namespace limpid::emulator {

/// What a host reads in a frame.
struct SeenFrame {
  explicit SeenFrame(const Bytes& bytes)
      : sequence{word(bytes, 4) | static_cast<std::uint32_t>(word(bytes, 6)) << 16U},
        time{word(bytes, 8) | static_cast<std::uint32_t>(word(bytes, 10)) << 16U},
        flags{word(bytes, 12)},
        boots{word(bytes, 14)},
        counts{signed_word(bytes, 20), signed_word(bytes, 22), signed_word(bytes, 24)} {}

  std::uint32_t sequence, time;
  std::uint16_t flags, boots;
  std::array<std::int16_t, 3> counts;

 private:
  static std::uint16_t word(const Bytes& bytes, std::size_t at) {
    return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8U);
  }
  static std::int16_t signed_word(const Bytes& bytes, std::size_t at) {
    return static_cast<std::int16_t>(word(bytes, at));
  }
};

/// Whether a transfer has brought a frame that is as it ought to be.
inline bool is_valid(const PlainClient::End& end) {
  const Bytes& bytes = end.bytes;
  if (end.status != LIBUSB_TRANSFER_COMPLETED || bytes.size() != 64) return false;
  Bytes sealed = bytes;
  seal(sealed);
  return sealed == bytes && bytes[0] == 'L' && bytes[1] == 'O' && bytes[2] == 1 && bytes[3] == 'S';
}

/// A bus with one emulated Omni, and a client that streams its frames.
struct Session {
  explicit Session(const EmulatedOmni::Settings& settings = {}, bool streams = true) : omni(bus, settings) {
    REQUIRE(client.open(settings.vendor, settings.product) == 0);
    REQUIRE(client.claim() == 0);
    if (streams) client.stream();
  }

  /// The next frame; nothing where the transfer has brought another thing.
  std::optional<SeenFrame> frame() {
    const auto end = client.next();
    if (!end || !is_valid(*end)) return std::nullopt;
    return SeenFrame(end->bytes);
  }
  bool frame_with(const std::function<bool(const SeenFrame&)>& wanted) {
    return client.find([&](const PlainClient::End& end) { return is_valid(end) && wanted(SeenFrame(end.bytes)); })
        .has_value();
  }
  bool end_with(libusb_transfer_status status) {
    return client.find([&](const PlainClient::End& end) { return end.status == status; }).has_value();
  }
  /// Whether the device comes to be so within 5 s.
  bool until(const std::function<bool(const OmniSnapshot&)>& wanted) const {
    for (int i = 0; i < 5000; ++i) {
      if (wanted(omni.snapshot())) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }

  EmulatedBus bus;
  EmulatedOmni omni;
  PlainClient client;
};

}  // namespace limpid::emulator
