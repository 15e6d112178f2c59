// SPDX-License-Identifier: MIT
#include "hotplug_log.hpp"
#include "session.hpp"

#include <emulator/known_devices.hpp>
#include <emulator/without_rights.hpp>

#include <doctest/doctest.h>

using namespace limpid;
using namespace limpid::emulator;

TEST_CASE("an unplugged device ends transfers and calls with NO_DEVICE, and can be opened once it is back") {
  Session session;
  REQUIRE(session.frame());
  session.omni.unplug();
  CHECK(session.end_with(LIBUSB_TRANSFER_NO_DEVICE));
  CHECK(session.client.send(command(1, {}, false, 50)) == LIBUSB_ERROR_NO_DEVICE);
  CHECK(libusb_clear_halt(session.client.handle(), 0x81) == LIBUSB_ERROR_NO_DEVICE);
  CHECK_FALSE(session.omni.snapshot().plugged);
  session.client.close();
  PlainClient absent;
  CHECK(absent.open(0x1209, 0x0001) == LIBUSB_ERROR_NOT_FOUND);

  session.omni.plug();
  PlainClient again;
  REQUIRE(again.open(0x1209, 0x0001, "1-1") == 0);
  REQUIRE(again.claim() == 0);
  again.stream();
  const auto end = again.next();
  REQUIRE(end);
  REQUIRE(is_valid(*end));
  CHECK(SeenFrame(end->bytes).boots == 2);
  CHECK(SeenFrame(end->bytes).counts == std::array<std::int16_t, 3>{});
}

TEST_CASE("hotplug tells of what leaves and arrives, on another path too") {
  Session session;
  HotplugLog log(session.client.context());
  CHECK(log.wait_for(LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED, "1-1"));  // that it is there
  session.omni.unplug();
  CHECK(log.wait_for(LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT, "1-1"));
  session.omni.plug("1-4");
  CHECK(log.wait_for(LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED, "1-4"));
  session.client.close();
  CHECK(session.client.open(0x1209, 0x0001, "1-4") == 0);
}

TEST_CASE("two devices have streams of their own, and one that goes leaves the other alone") {
  EmulatedOmni::Settings other;
  other.path = "2-3";
  other.boots = 40;
  Session session;
  EmulatedOmni second(session.bus, other);
  PlainClient client;
  REQUIRE(client.open(0x1209, 0x0001, "2-3") == 0);
  REQUIRE(client.claim() == 0);
  client.stream();
  const auto end = client.next();
  REQUIRE(end);
  CHECK(SeenFrame(end->bytes).boots == 40);
  CHECK(session.frame()->boots == 1);
  second.unplug();
  CHECK(client.find([](const auto& one) { return one.status == LIBUSB_TRANSFER_NO_DEVICE; }));
  for (int i = 0; i < 20; ++i) CHECK(session.frame());
}

TEST_CASE("a second client may open the device and not claim it") {
  Session session;
  PlainClient second;
  REQUIRE(second.open(0x1209, 0x0001) == 0);
  CHECK(second.claim() == LIBUSB_ERROR_BUSY);
  session.client.close();
  CHECK(second.claim() == 0);
}

TEST_CASE("a client that goes without a word leaves its interface and transfers to the next") {
  Session session;
  REQUIRE(session.frame());
  session.client.close();
  CHECK(session.until([](const OmniSnapshot& now) { return !now.claimed; }));
  REQUIRE(session.client.open(0x1209, 0x0001) == 0);
  REQUIRE(session.client.claim() == 0);
  session.client.stream();
  CHECK(session.frame());
}

TEST_CASE("a device node without rights for others cannot be opened by them") {
  EmulatedBus bus;
  EmulatedOmni::Settings settings;
  settings.mode = 0600;
  const EmulatedOmni omni(bus, settings);
  PlainClient client;
  {
    const WithoutRights nobody;
    CHECK(client.open(0x1209, 0x0001) == LIBUSB_ERROR_ACCESS);
  }
  if (!WithoutRights::only_by_mode()) CHECK(client.open(0x1209, 0x0001) == 0);
}

TEST_CASE("a device that a kernel driver has is busy until the driver is detached") {
  EmulatedBus bus;
  const EmulatedUsbDevice touch(bus, touch_stylus());
  PlainClient client;
  REQUIRE(client.open(0x0301, 0x2988) == 0);
  CHECK(libusb_kernel_driver_active(client.handle(), 0) == 1);
  CHECK(client.claim() == LIBUSB_ERROR_BUSY);
  CHECK(client.claim_from_driver() == 0);
}

TEST_CASE("devices of other kinds show their ids") {
  EmulatedBus bus;
  const EmulatedUsbDevice stylus(bus, touch_stylus("1-1")), usb(bus, touch_usb("1-2")), hid(bus, touch_hid("1-3")),
      novint(bus, falcon("1-4"));
  PlainClient client;
  for (const auto& [vendor, product] :
       {std::pair{0x0301, 0x2988}, std::pair{0x2988, 0x0302}, std::pair{0x2988, 0x0304}, std::pair{0x0403, 0xcb48}}) {
    CHECK(client.open(static_cast<std::uint16_t>(vendor), static_cast<std::uint16_t>(product)) == 0);
    client.close();
  }
}
