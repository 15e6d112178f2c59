// SPDX-License-Identifier: MIT
// What libusb makes of each fault: the table of the device notes.
#include "session.hpp"

#include <doctest/doctest.h>

using namespace limpid;
using namespace limpid::emulator;
using End = PlainClient::End;

namespace {

bool completed(const End& end) { return end.status == LIBUSB_TRANSFER_COMPLETED; }

bool comes_back(Session& session) {
  return session.client.find([](const End& end) { return is_valid(end); }).has_value();
}

}  // namespace

TEST_CASE("a short packet completes with fewer bytes") {
  Session session;
  session.omni.set(OmniFault::short_packet, 3);
  const auto end = session.client.find([](const End& one) { return one.bytes.size() != 64; });
  REQUIRE(end);
  CHECK(completed(*end));
  CHECK(end->bytes.size() == 32);
  CHECK(comes_back(session));
}

TEST_CASE("a short packet is an error where the transfer must not be short") {
  Session session({}, false);
  session.client.stream(0x81, 4, LIBUSB_TRANSFER_SHORT_NOT_OK);
  session.omni.set(OmniFault::short_packet, 3);
  CHECK(session.end_with(LIBUSB_TRANSFER_ERROR));
  CHECK(comes_back(session));
}

TEST_CASE("frames with a wrong CRC, magic, version or kind complete like others") {
  Session session;
  for (const OmniFault fault :
       {OmniFault::corrupt, OmniFault::wrong_magic, OmniFault::wrong_version, OmniFault::wrong_kind}) {
    session.omni.set(fault, 3);
    const auto end = session.client.find([](const End& one) { return !is_valid(one); });
    REQUIRE(end);
    CHECK(completed(*end));
    CHECK(end->bytes.size() == 64);
    Bytes sealed = end->bytes;
    seal(sealed);
    CHECK((sealed == end->bytes) == (fault != OmniFault::corrupt));
    CHECK(session.until([&](const OmniSnapshot& now) { return now.frames > 3; }));
    CHECK(comes_back(session));
  }
}

TEST_CASE("a stall of IN lasts until the host clears the halt") {
  Session session;
  session.omni.set(OmniFault::stall_in);
  CHECK(session.end_with(LIBUSB_TRANSFER_STALL));
  session.client.stop();
  session.client.stream();
  CHECK(session.end_with(LIBUSB_TRANSFER_STALL));
  session.client.stop();
  CHECK(libusb_clear_halt(session.client.handle(), 0x81) == 0);
  session.client.stream();
  CHECK(comes_back(session));
}

TEST_CASE("a stall of OUT lasts until the host clears the halt") {
  Session session;
  session.omni.set(OmniFault::stall_out);
  CHECK(session.client.send(command(1, {}, false, 50)) == LIBUSB_ERROR_PIPE);
  CHECK(session.client.send(command(2, {}, false, 50)) == LIBUSB_ERROR_PIPE);
  CHECK(libusb_clear_halt(session.client.handle(), 0x01) == 0);
  CHECK(session.client.send(command(3, {}, false, 50)) == 0);
  CHECK(session.frame());
}

TEST_CASE("babble is an overflow") {
  Session session;
  session.omni.set(OmniFault::babble, 3);
  CHECK(session.end_with(LIBUSB_TRANSFER_OVERFLOW));
  CHECK(comes_back(session));
}

TEST_CASE("a bad cable is an error, on IN and on OUT") {
  Session session;
  session.omni.set(OmniFault::protocol_error, 3);
  CHECK(session.end_with(LIBUSB_TRANSFER_ERROR));
  CHECK(comes_back(session));
  session.omni.set(OmniFault::protocol_error_out);
  CHECK(session.client.send(command(1, {}, false, 50)) == LIBUSB_ERROR_IO);
  session.omni.clear(OmniFault::protocol_error_out);
  CHECK(session.client.send(command(2, {}, false, 50)) == 0);
}

TEST_CASE("silence is a time-out, and ends") {
  Session session({}, false);
  session.omni.set(OmniFault::silence);
  std::array<unsigned char, 64> bytes{};
  int got = 0;
  int answer = 0;  // frames that are kept come first
  for (int i = 0; i < 4 && answer == 0; ++i)
    answer = libusb_interrupt_transfer(session.client.handle(), 0x81, bytes.data(), 64, &got, 100);
  CHECK(answer == LIBUSB_ERROR_TIMEOUT);
  session.omni.clear(OmniFault::silence);
  CHECK(libusb_interrupt_transfer(session.client.handle(), 0x81, bytes.data(), 64, &got, 2000) == 0);
  CHECK(got == 64);
}

TEST_CASE("a stuck OUT is a time-out, and ends") {
  Session session;
  session.omni.set(OmniFault::out_stuck);
  CHECK(session.client.send(command(1, {}, false, 50), 100) == LIBUSB_ERROR_TIMEOUT);
  session.omni.clear(OmniFault::out_stuck);
  CHECK(session.client.send(command(2, {}, false, 50)) == 0);
  CHECK(session.until([](const OmniSnapshot& now) { return now.commands == 1; }));
}

TEST_CASE("lost frames leave gaps in the sequence, repeated ones and stuck ones none") {
  Session session;
  const auto steps = [&] {
    std::array<int, 4> count{};
    std::uint32_t last = session.frame()->sequence;
    for (int i = 0; i < 60; ++i) {
      const auto frame = session.frame();
      REQUIRE(frame);
      ++count[std::min<std::uint32_t>(frame->sequence - last, 3)];
      last = frame->sequence;
    }
    return count;
  };
  session.omni.set(OmniFault::lost);
  (void)steps();  // what was under way
  CHECK(steps()[2] >= 20);
  session.omni.clear_faults();
  session.omni.set(OmniFault::repeated);
  (void)steps();
  CHECK(steps()[0] >= 10);
  session.omni.clear_faults();
  session.omni.set(OmniFault::stuck);
  (void)steps();
  CHECK(steps()[0] >= 59);
}

TEST_CASE("frozen counts stay in frames that go on, and absurd ones leap") {
  Session session;
  session.omni.let_go();  // it falls
  session.omni.set(OmniFault::frozen);
  for (int i = 0; i < 20; ++i) REQUIRE(session.frame());
  const auto first = session.frame();
  for (int i = 0; i < 50; ++i) REQUIRE(session.frame());
  const auto later = session.frame();
  REQUIRE(first);
  REQUIRE(later);
  CHECK(later->sequence > first->sequence);
  CHECK(later->counts == first->counts);
  session.omni.clear_faults();
  CHECK(session.frame_with([&](const SeenFrame& frame) { return frame.counts != first->counts; }));
  session.omni.set(OmniFault::absurd);
  std::int16_t before = session.frame()->counts[1];
  CHECK(session.frame_with([&](const SeenFrame& frame) {
    return std::abs(std::exchange(before, frame.counts[1]) - frame.counts[1]) > 10'000;
  }));
}

TEST_CASE("a slow device sends a frame every 5 ms") {
  Session session;
  session.omni.set(OmniFault::slow);
  for (int i = 0; i < 10; ++i) REQUIRE(session.frame());
  std::uint32_t time = session.frame()->time;
  for (int i = 0; i < 20; ++i) {
    const auto frame = session.frame();
    REQUIRE(frame);
    CHECK(frame->time - time >= 4000);  // us; it stands still where the machine does
    time = frame->time;
  }
}

TEST_CASE("a device that loses power in between counts from a new zero, with another number of boots") {
  Session session;
  session.omni.reboot();
  CHECK(session.frame_with(
      [](const SeenFrame& frame) { return frame.boots == 2 && frame.counts == std::array<std::int16_t, 3>{}; }));
}
