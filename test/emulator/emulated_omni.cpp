// SPDX-License-Identifier: MIT
#include "emulated_omni.hpp"

#include <sys/prctl.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace limpid::emulator {
namespace {

constexpr Duration period = std::chrono::milliseconds(1);
constexpr int most_late = 5;  // ticks that are made up for; what is more, the emulator stood still

UsbSettings usb_of(const EmulatedOmni::Settings& settings) {
  return {.path = settings.path,
          .vendor = settings.vendor,
          .product = settings.product,
          .name = "OmniBridge",
          .serial = settings.serial,
          .interfaces = {{.endpoints = {{.address = EmulatedOmni::in}, {.address = EmulatedOmni::out}}}},
          .mode = settings.mode};
}

}  // namespace

EmulatedOmni::EmulatedOmni(EmulatedBus& bus, const Settings& settings)
    : device_{bus, usb_of(settings), settings.plugged}, arm_{settings.arm}, home_{settings.arm.home} {
  seen_.boots = settings.boots;
  seen_.docked = settings.docked;
  frame_.sequence = settings.sequence;
  clock_ = settings.uptime;
  set_gimbal(settings.gimbal);
  thread_ = std::thread([this] { run(); });
}

EmulatedOmni::~EmulatedOmni() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  thread_.join();
}

void EmulatedOmni::run() {
  ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  Time next = steady_now() + period;
  std::unique_lock lock(mutex_);
  while (true) {
    lock.unlock();
    std::this_thread::sleep_for(next - steady_now());
    lock.lock();
    if (stopping_) return;
    const Time now = steady_now();
    if (now - next > most_late * period) {
      ++seen_.pauses;
      next = now;
    }
    for (; next <= now; next += period) tick(next);
    make_frame(device_.usbfs().get());
  }
}

void EmulatedOmni::tick(Time when) {
  clock_ += period;
  ++ticks_;
  if (const auto usbfs = device_.usbfs()) take_command(*usbfs, when);
  const bool had_torque = board_.motors_on();
  if (board_.watch(clock_)) {
    ++seen_.watchdog_trips;
    if (had_torque) ++seen_.watchdog_trips_with_torque;
  }
  track_motors(when);
  arm_.write(board_.dac());
  arm_.advance(period);
  seen_.largest_torque = seen_.largest_torque.cwiseMax(arm_.torque().cwiseAbs());
}

// The bus brings one packet a millisecond.
void EmulatedOmni::take_command(Usbfs& usbfs, Time when) {
  if (faults_.has(OmniFault::out_stuck)) return;
  if (faults_.has(OmniFault::protocol_error_out)) {
    usbfs.fail(out, EPROTO);
    return;
  }
  const auto packet = usbfs.receive(out);
  if (!packet) return;
  if (!board_.take(clock_, *packet)) {
    ++seen_.commands_invalid;
    return;
  }
  ++seen_.commands;
  seen_.last_command = when;
  if (board_.wants_motors() && !board_.motors_on()) ++seen_.commands_refused;
  const auto last = board_.last();
  seen_.last_dac = last->dac;
  seen_.watchdog = last->watchdog;
  if (std::any_of(last->dac.begin(), last->dac.end(), [](auto dac) { return dac > 4095; })) ++seen_.dac_out_of_range;
}

void EmulatedOmni::track_motors(Time when) {
  const bool on = board_.motors_on();
  if (on && !motors_were_on_) {
    if (!seen_.motors_since) seen_.motors_since = when;
    arm_.let_go();
  }
  if (!on && motors_were_on_) seen_.motors_until = when;
  motors_were_on_ = on;
}

OmniFrame EmulatedOmni::measured() const {
  OmniFrame frame = frame_;
  frame.time = static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::microseconds>(clock_).count());
  frame.flags = board_.flags();
  frame.boots = seen_.boots;
  frame.docked = seen_.docked;
  if (!faults_.has(OmniFault::frozen)) frame.counts = arm_.counts();
  if (faults_.has(OmniFault::absurd) && frame.sequence % 2 != 0) {
    for (auto& count : frame.counts) count = static_cast<std::int16_t>(count + (count < 0 ? 12'000 : -12'000));
  }
  return frame;
}

Bytes EmulatedOmni::spoiled(Bytes frame) const {
  if (faults_.has(OmniFault::wrong_magic)) frame[0] = 'X';
  if (faults_.has(OmniFault::wrong_version)) frame[2] = 2;
  if (faults_.has(OmniFault::wrong_kind)) frame[3] = 'C';
  seal(frame);
  if (faults_.has(OmniFault::corrupt)) frame[20] ^= 0x10U;
  if (faults_.has(OmniFault::short_packet)) frame.resize(state_length / 2);
  return frame;
}

void EmulatedOmni::make_frame(Usbfs* usbfs) {
  if (faults_.has(OmniFault::slow) && ticks_ % 5 != 0) return;
  const bool again = faults_.has(OmniFault::stuck) || (faults_.has(OmniFault::repeated) && ticks_ % 2 != 0);
  if (!again || last_frame_.empty()) {
    ++frame_.sequence;
    ++seen_.frames;
    const OmniFrame frame = measured();
    if (!faults_.has(OmniFault::absurd)) frame_.counts = frame.counts;  // where they freeze
    last_frame_ = encode(frame);
  }
  if (usbfs != nullptr) deliver(*usbfs, last_frame_);
  faults_.count_frame();
}

void EmulatedOmni::deliver(Usbfs& usbfs, const Bytes& frame) {
  if (faults_.has(OmniFault::silence)) return;
  if (faults_.has(OmniFault::lost) && frame_.sequence % 3 == 0) return;
  if (faults_.has(OmniFault::babble) || faults_.has(OmniFault::protocol_error)) {
    usbfs.fail(in, faults_.has(OmniFault::babble) ? EOVERFLOW : EPROTO);
    return;
  }
  const auto sent = usbfs.send(in, spoiled(frame));
  seen_.last_frame = frame_.sequence;
  if (sent == Usbfs::Sent::taken) ++seen_.frames_taken;
  if (sent == Usbfs::Sent::replaced) ++seen_.frames_replaced;
}

void EmulatedOmni::set(OmniFault fault, int frames) {
  const std::lock_guard lock(mutex_);
  const auto usbfs = device_.usbfs();
  if (fault == OmniFault::stall_in || fault == OmniFault::stall_out) {
    if (usbfs) usbfs->halt(fault == OmniFault::stall_in ? in : out, frames != 0);
    return;  // the host ends it
  }
  if (fault == OmniFault::out_refused && usbfs) usbfs->refuse(out, frames != 0 ? ENOMEM : 0);
  faults_.set(fault, frames);
}

void EmulatedOmni::clear(OmniFault fault) { set(fault, 0); }

void EmulatedOmni::clear_faults() {
  const std::lock_guard lock(mutex_);
  faults_.clear();
  if (const auto usbfs = device_.usbfs()) {
    usbfs->refuse(out, 0);
    if (usbfs->halted(in)) usbfs->halt(in, false);
    if (usbfs->halted(out)) usbfs->halt(out, false);
  }
}

void EmulatedOmni::power_up(bool counted) {
  board_.power_up();
  track_motors(steady_now());
  clock_ = Time{};
  frame_.sequence = 0;
  last_frame_.clear();
  if (counted) ++seen_.boots;
}

void EmulatedOmni::unplug() {
  {
    const std::lock_guard lock(mutex_);  // powered by the bus
    board_.power_up();
    track_motors(steady_now());
  }
  device_.unplug();
}

void EmulatedOmni::plug(const std::optional<std::string>& path, bool at_home) {
  {
    const std::lock_guard lock(mutex_);
    power_up();
    if (at_home) {
      arm_.zero_counts(home_);
    } else {
      arm_.zero_counts();
    }
  }
  device_.plug(path);
}

void EmulatedOmni::reboot(bool counted) {
  const std::lock_guard lock(mutex_);
  power_up(counted);
  arm_.zero_counts();
}

void EmulatedOmni::mark() {
  const std::lock_guard lock(mutex_);
  seen_.largest_torque = arm_.torque().cwiseAbs();
}

void EmulatedOmni::set_docked(bool docked) {
  const std::lock_guard lock(mutex_);
  seen_.docked = docked;
}

void EmulatedOmni::set_pressed(bool first, bool second) {
  const std::lock_guard lock(mutex_);
  frame_.pressed = {first, second};
}

void EmulatedOmni::set_gimbal(const Eigen::Vector3d& gimbal) {
  const std::lock_guard lock(mutex_);
  frame_.gimbal = {gimbal[0], gimbal[1], gimbal[2]};
}

void EmulatedOmni::set_force(EmulatedArm::Force force) {
  const std::lock_guard lock(mutex_);
  arm_.set_force(std::move(force));
}

void EmulatedOmni::let_go() {
  const std::lock_guard lock(mutex_);
  arm_.let_go();
}

OmniSnapshot EmulatedOmni::snapshot() const {
  const std::lock_guard lock(mutex_);
  OmniSnapshot answer = seen_;
  const auto usbfs = device_.usbfs();
  answer.plugged = usbfs != nullptr;
  answer.claimed = usbfs && usbfs->claimed(0);
  answer.motors_on = board_.motors_on();
  answer.flags = board_.flags();
  answer.counts = arm_.counts();
  answer.torque = arm_.torque();
  answer.force = arm_.force();
  answer.joints = arm_.state();
  answer.tip = Omni<>{}.at(answer.joints.q).position();
  return answer;
}

}  // namespace limpid::emulator
