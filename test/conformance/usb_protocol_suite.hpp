// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/usb/usb_protocol.hpp>

#include "support/no_allocation.hpp"

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

namespace limpid::test {

/// Puts a protocol through the laws of the UsbProtocol concept.
/// @param frame  one that a device may say
template <UsbProtocol P>
void check_usb_protocol(const std::vector<std::byte>& frame) {
  using namespace std::chrono_literals;
  REQUIRE(frame.size() <= P::in_length);
  CHECK(P::decode(frame).fault == FrameFault::none);
  for (std::size_t length = 0; length < frame.size(); ++length) {
    CHECK(P::decode(std::span(frame).first(length)).fault != FrameFault::none);
  }
  const unsigned seed = 19740115;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::vector<std::byte> any(P::in_length);
  for (int i = 0; i < 10'000; ++i) {  // any bytes: an answer, and no more
    for (std::byte& byte : any) byte = static_cast<std::byte>(random());
    any.resize(random() % (P::in_length + 1));
    (void)P::decode(any);
    any.resize(P::in_length);
  }
  const auto once = P::encode(P::safe(), 7, 20ms), again = P::encode(P::safe(), 7, 20ms);
  CHECK(once == again);
  const auto state = P::decode(frame).state;
  CHECK(P::steps(state, state) <= 1);
  check_no_allocation([&] {
    (void)P::decode(frame);
    (void)P::encode(P::safe(), 8, 20ms);
    (void)P::steps(state, state);
  });
}

}  // namespace limpid::test
