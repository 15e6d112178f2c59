// SPDX-License-Identifier: MIT
// Which device is opened, and what is said where none can be.
#include <limpid/device/usb/omni_bridge.hpp>
#include <limpid/device/usb/usb_link.hpp>

#include "emulator/emulated_bus.hpp"
#include "emulator/emulated_omni.hpp"
#include "emulator/without_rights.hpp"
#include "usb/usb_bench.hpp"

#include <doctest/doctest.h>

#include <string>

using limpid::OmniBridge, limpid::UsbError, limpid::UsbFailure;
using limpid::emulator::EmulatedBus, limpid::emulator::EmulatedOmni, limpid::emulator::WithoutRights;
using limpid::test::UsbBench;
using Link = limpid::UsbLink<OmniBridge>;

namespace {

struct Refusal {
  UsbFailure failure{};
  std::string words;
};

Refusal refusal(const limpid::UsbLinkSettings& settings = {}) {
  try {
    const Link link(settings);
  } catch (const UsbError& error) {
    return {error.failure(), error.what()};
  }
  FAIL("a device was opened");
  return {};
}

EmulatedOmni::Settings at(const std::string& path) {
  auto settings = UsbBench::docked_at_start();
  settings.path = path;
  return settings;
}

}  // namespace

TEST_CASE("without a device the error says which was looked for") {
  const EmulatedBus bus;
  const auto [failure, words] = refusal();
  CHECK(failure == UsbFailure::not_found);
  CHECK(words == "UsbLink: expected a device 1209:0001 to be plugged in, got none");
}

TEST_CASE("of several devices one must be named") {
  EmulatedBus bus;
  const EmulatedOmni first(bus, at("1-1")), second(bus, at("1-2"));
  const auto [failure, words] = refusal();
  CHECK(failure == UsbFailure::several);
  CHECK(words.find("1-1") != std::string::npos);
  CHECK(words.find("1-2") != std::string::npos);
  CHECK(words.find("UsbLink: path") != std::string::npos);
  Link link({.path = "1-2"});
  CHECK(link.connected());
  CHECK(second.snapshot().claimed);
  CHECK(!first.snapshot().claimed);
}

TEST_CASE("a device at another place than the one named is not taken") {
  EmulatedBus bus;
  const EmulatedOmni omni(bus, at("1-1"));
  const auto [failure, words] = refusal({.path = "1-4"});
  CHECK(failure == UsbFailure::not_found);
  CHECK(words == "UsbLink: expected a device 1209:0001 at 1-4 to be plugged in, got one at 1-1");
}

TEST_CASE("a board with numbers of its own is found by them") {
  EmulatedBus bus;
  auto settings = at("1-1");
  settings.vendor = 0x1209;
  settings.product = 0xbeef;
  const EmulatedOmni omni(bus, settings);
  CHECK(refusal().failure == UsbFailure::not_found);
  CHECK(Link({.identities = {{0x1209, 0xbeef}}}).connected());
}

TEST_CASE("the Touch family is refused in words") {
  for (const auto& touch : {limpid::UsbIdentity{0x0301, 0x2988}, {0x2988, 0x0302}, {0x2988, 0x0304}}) {
    EmulatedBus bus;
    auto settings = at("1-1");
    settings.vendor = touch.vendor;
    settings.product = touch.product;
    const EmulatedOmni device(bus, settings);
    const auto [failure, words] = refusal();
    CHECK(failure == UsbFailure::refused);
    CHECK(words.find("3D Systems Touch (" + limpid::describe(touch)) != std::string::npos);
    CHECK(words.find("the vendor's USB protocol is not documented") != std::string::npos);
  }
}

TEST_CASE("a device that another program has is busy") {
  EmulatedBus bus;
  const EmulatedOmni omni(bus, at("1-1"));
  const Link link;
  const auto [failure, words] = refusal();
  CHECK(failure == UsbFailure::busy);
  CHECK(words.find("claim its interface") != std::string::npos);
}

TEST_CASE("without the permission the error names the udev rule") {
  EmulatedBus bus;
  auto settings = at("1-1");
  settings.mode = WithoutRights::only_by_mode() ? 0 : 0600;
  const EmulatedOmni omni(bus, settings);
  const WithoutRights nobody;
  const auto [failure, words] = refusal();
  CHECK(failure == UsbFailure::permission);
  CHECK(words.find("60-limpid-usb.rules") != std::string::npos);
}
