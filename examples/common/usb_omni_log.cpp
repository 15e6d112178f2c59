// SPDX-License-Identifier: MIT
#include "usb_omni_log.hpp"

#include <limpid/loop/realtime/periodic_loop.hpp>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

namespace limpid::examples {

namespace {

using namespace std::chrono_literals;

constexpr Duration poll = 250us, between_clears = 100ms;
using Rows = RecentValues<OmniRecord, 4096>;  // 4 s

// The side that must not wait.
class Reader {
 public:
  Reader(UsbOmni& omni, Rows& rows) : omni_{omni}, rows_{rows} {}

  void tick(Time now) noexcept {
    const DeviceState<3> seen = omni_.read(now);
    const std::uint64_t count = omni_.states();
    if (count != last_) {
      if (last_ > 0) unread += count - last_ - 1;
      last_ = count;
      DeviceState<3> stamped = seen;
      if (!omni_.calibrated()) stamped.stamp = now;  // it has none yet
      if (!std::exchange(begun_, true)) begin_ = stamped.stamp;
      rows_.write(record_of(stamped, omni_.state(), omni_.calibrated(), begin_));
    }
    if (omni_.fault() == UsbFault::none || now - cleared_ < between_clears) return;
    omni_.clear_fault();
    cleared_ = now;
  }

  std::uint64_t unread = 0;

 private:
  UsbOmni& omni_;
  Rows& rows_;
  std::uint64_t last_ = 0;
  Time begin_{}, cleared_{};
  bool begun_ = false;
};

}  // namespace

OmniLogLosses log_omni(UsbOmni& omni, Duration duration, std::stop_source stop,
                       const std::function<void(const std::string&)>& write) {
  const auto rows = std::make_unique<Rows>();
  OmniLogLosses losses;
  Reader reader(omni, *rows);
  PeriodicLoop loop({.period = poll, .duration = duration});
  std::atomic<bool> ended = false;
  std::jthread thread([&] {
    loop.run(stop.get_token(), [&](const TickTime& at) noexcept { reader.tick(at.now); });
    ended = true;
  });
  std::uint64_t next = 0;
  const auto drain = [&] {
    std::string text;
    for (OmniRecord row; next < rows->written();) {
      if (!rows->read(next, row)) {
        losses.unwritten += rows->oldest() - next;
        next = rows->oldest();
        continue;
      }
      text += csv_line(row);
      ++losses.rows;
      ++next;
    }
    if (!text.empty()) write(text);
  };
  try {
    while (!ended) {
      std::this_thread::sleep_for(20ms);
      drain();
    }
    drain();
  } catch (...) {
    stop.request_stop();  // for the thread that is joined now
    throw;
  }
  thread.join();
  losses.unread = reader.unread;
  return losses;
}

}  // namespace limpid::examples
