// SPDX-License-Identifier: MIT
#include "usb/stream.hpp"

#include "usb/rig.hpp"

#include <sys/resource.h>

#include <chrono>
#include <cstddef>
#include <stop_token>
#include <utility>

namespace limpid::bench {
namespace {

constexpr Duration period = std::chrono::milliseconds(1);

// Whether all of a state is of one frame: in this emulator the two halves of a potentiometer make 8000, and its clock
// and its numbers go on together.
bool is_whole(const OmniBridge::State& state, const OmniBridge::State& before) {
  for (std::size_t i = 0; i < 3; ++i)
    if (state.gimbal_a[i] + state.gimbal_b[i] != 8000) return false;
  const std::uint32_t steps = state.sequence - before.sequence, time = state.device_time - before.device_time;
  return steps > 0 && steps < 1U << 31U && time % 1000 == 0 && time >= 1000 * steps && state.boots == before.boots;
}

class Stream {
 public:
  explicit Stream(int seconds) : longest_{std::chrono::seconds(seconds)} {
    figures_.seconds.reserve(static_cast<std::size_t>(seconds));
  }

  StreamFigures measure() {
    if (!rig_.start()) return {};
    last_ = rig_.omni->state();
    count_ = rig_.omni->states();
    before_ = totals();
    PeriodicLoop loop({.period = period, .duration = longest_});
    figures_.lateness = loop.run(std::stop_token{}, [&](const TickTime& at) noexcept { tick(at); }).lateness;
    end_second();
    return std::move(figures_);
  }

 private:
  void tick(const TickTime& at) noexcept {
    if (at.index == 0) begin_ = at.now;
    const bool full = at.now - begin_ >= std::chrono::seconds(1);
    if (full && figures_.seconds.size() + 1 < figures_.seconds.capacity()) end_second();
    const Costs costs = call(at.now);
    if (rig_.omni->states() != count_) look(costs.stamp);
    last_begin_ = at.now;
    if (rig_.omni->fault() != UsbFault::none) rig_.omni->clear_fault();  // it is counted
    second_.misses += at.missed + (steady_now() - at.now > period ? 1U : 0U);
    const bool calm = was_calm();
    figures_.read.add(costs.read, calm);
    figures_.write.add(costs.write, calm);
    figures_.same.add(costs.same, calm);
  }

  struct Costs {
    Duration read{}, write{}, same{};
    Time stamp{};
  };

  Costs call(Time now) noexcept {
    Costs costs;
    const Time start = steady_now();
    const auto seen = rig_.omni->read(now);
    costs.read = steady_now() - start;
    costs.stamp = seen.stamp;
    figures_.age.add(now - seen.stamp);
    const auto torque = rig_.torque(now, seen);
    const Time middle = steady_now();
    (void)rig_.omni->write(torque);
    const Time written = steady_now();
    costs.write = written - middle;
    for (int i = 0; i < 100; ++i) spin_ = spin_ * 1.0000001 + 1e-9;  // each after the other
    costs.same = steady_now() - written;
    return costs;
  }

  // Whether this thread kept its processor since it was asked last, or had given it away by itself.
  bool was_calm() noexcept {
    rusage usage{};
    ::getrusage(RUSAGE_THREAD, &usage);
    return std::exchange(switches_, usage.ru_nivcsw) == usage.ru_nivcsw;
  }

  void look(Time stamp) noexcept {
    const auto& state = rig_.omni->state();
    count_ = rig_.omni->states();
    ++second_.taken;
    if (stamp < last_begin_) ++second_.late;
    if (!is_whole(state, last_)) ++second_.torn;
    last_ = state;
  }

  // What is counted elsewhere, since the start.
  [[nodiscard]] StreamSecond totals() const {
    const auto& counters = rig_.omni->counters();
    const auto is = rig_.device.snapshot();
    return {.states = counters[UsbCount::states],
            .damaged = counters[UsbCount::damaged],
            .lost = counters[UsbCount::lost],
            .faults = counters[UsbCount::faults],
            .pauses = is.pauses,
            .replaced = is.frames_replaced};
  }

  void end_second() noexcept {
    const StreamSecond now = totals();
    second_.states = now.states - before_.states;
    second_.damaged = now.damaged - before_.damaged;
    second_.lost = now.lost - before_.lost;
    second_.pauses = now.pauses - before_.pauses;
    second_.faults = now.faults - before_.faults;
    second_.replaced = now.replaced - before_.replaced;
    figures_.seconds.push_back(std::exchange(second_, {}));
    before_ = now;
    begin_ += std::chrono::seconds(1);
  }

  Duration longest_;
  Rig rig_;
  StreamFigures figures_;
  StreamSecond second_, before_;
  OmniBridge::State last_;
  std::uint64_t count_ = 0;
  Time begin_{};       // of the second
  Time last_begin_{};  // of the last tick
  long switches_ = 0;
  double spin_ = 1;
};

}  // namespace

StreamFigures measure_stream(int seconds) { return Stream(seconds).measure(); }

}  // namespace limpid::bench
