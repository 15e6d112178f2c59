// SPDX-License-Identifier: MIT
#include "session.hpp"

#include <doctest/doctest.h>

using namespace limpid;
using namespace limpid::emulator;

TEST_CASE("an emulated Omni is found by its ids and streams valid frames in sequence") {
  Session session;
  const auto first = session.frame();
  REQUIRE(first);
  std::uint32_t last = first->sequence, time = first->time;
  int gaps = 0;
  for (int i = 0; i < 200; ++i) {
    const auto frame = session.frame();
    REQUIRE(frame);
    gaps += static_cast<int>(frame->sequence - last) - 1;
    CHECK(frame->time > time);
    CHECK(frame->boots == 1);
    CHECK(frame->flags == 0);
    last = frame->sequence;
    time = frame->time;
  }
  CHECK(gaps <= static_cast<int>(session.omni.snapshot().frames_replaced));  // none but on a machine that is too busy
}

TEST_CASE("its strings and path can be asked for") {
  Session session;
  std::array<unsigned char, 64> text{};
  CHECK(libusb_get_string_descriptor_ascii(session.client.handle(), 3, text.data(), 64) == 8);
  CHECK(std::string(text.begin(), text.begin() + 8) == "EMULATED");
  CHECK(path_of(libusb_get_device(session.client.handle())) == "1-1");
}

TEST_CASE("its counts are those of the pose from home") {
  Session session;
  const auto frame = session.frame();
  REQUIRE(frame);
  // device angles (0, pi/4, -1.25 + pi/4 + pi/2) less (0, 0.23, -0.37), in 15000ths of a turn
  CHECK(frame->counts[0] == 0);
  CHECK(frame->counts[1] == -1326);
  CHECK(frame->counts[2] == 3524);
}

TEST_CASE("a command moves the arm, and its motors are off once no command comes") {
  Session session;
  const auto before = session.omni.snapshot().joints.q;
  std::uint32_t sequence = 0;
  for (int i = 0; i < 100; ++i) CHECK(session.client.send(command(++sequence, {2047, 4095, 2047}, true, 50)) == 0);
  auto seen = session.omni.snapshot();
  CHECK(seen.commands == 100);
  CHECK(seen.commands_invalid == 0);
  CHECK(seen.joints.q[1] > before[1]);
  CHECK(seen.largest_torque[1] == doctest::Approx(0.29));
  CHECK(session.until([](const OmniSnapshot& now) { return now.watchdog_trips_with_torque == 1; }));
  seen = session.omni.snapshot();
  CHECK_FALSE(seen.motors_on);
  CHECK(seen.torque.norm() == 0);
  CHECK(seen.motors_until);
  CHECK(session.frame_with([](const SeenFrame& frame) { return frame.flags == 3; }));
}

TEST_CASE("the arm stays where it is held until motors have torque, and the operator's force begins then") {
  EmulatedOmni::Settings settings;
  settings.arm.force = [](double t) { return Eigen::Vector3d(0, 0, t < 0.05 ? 1 : 2); };
  Session session(settings);
  CHECK(session.omni.snapshot().force.norm() == 0);
  CHECK(session.omni.snapshot().joints.q == SimulatedOmni<>::start_pose());
  CHECK(session.client.send(command(1, {2047, 2047, 2047}, true, 1000)) == 0);
  CHECK(session.until([](const OmniSnapshot& now) { return now.force[2] == 1; }));
  CHECK(session.until([](const OmniSnapshot& now) { return now.force[2] == 2; }));
}

TEST_CASE("an invalid command is counted and does nothing") {
  Session session;
  Bytes wrong = command(1, {4095, 4095, 4095}, true, 50);
  wrong[31] ^= 1U;
  CHECK(session.client.send(wrong) == 0);
  CHECK(session.until([](const OmniSnapshot& now) { return now.commands_invalid == 1; }));
  CHECK_FALSE(session.omni.snapshot().motors_on);
}
