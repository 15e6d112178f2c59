// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/latest_value.hpp>
#include <limpid/core/status.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/usb/usb_counters.hpp>
#include <limpid/device/usb/usb_device.hpp>
#include <limpid/device/usb/usb_fault.hpp>
#include <limpid/device/usb/usb_link_settings.hpp>
#include <limpid/device/usb/usb_protocol.hpp>
#include <limpid/device/usb/usb_stream.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <thread>

#include <pthread.h>
#include <sched.h>

namespace limpid {

/// What the loop reads of a device.
template <typename State>
struct UsbReading {
  State state{};                      ///< the newest
  Time stamp{};                       ///< when it came, by `steady_now`
  std::uint64_t count = 0;            ///< of states up to this one
  std::uint32_t opening = 0;          ///< of the device: with another one, it may have begun anew or be another device
  bool fresh = false;                 ///< whether it came since the last reading
  Status status = Status::no_sample;  ///< no_sample, stale, disconnected, fault
  UsbFault fault = UsbFault::none;    ///< that is latched and was not cleared
};

/// A device on USB that says and hears protocol P, by libusb-1.0: a thread of its own handles all that libusb does, and
/// exchanges the newest state and command with the loop, which never waits and never calls the system.
///
/// A command goes out as the next state comes, or as `poll` says. The device has its own watchdog, which this needs;
/// where the loop gives no command for `host_watchdog`, no state comes for `stale_after`, no command gets through, or
/// the device goes away, the link sends what takes its motors off, latches the fault and drops all commands until
/// `clear` was called and all is well again. A device that went away is looked for, opened again, and has its motors
/// off. The destructor takes them off, twice.
///
/// A fault has a number, and `clear` is for the one that `read` told last: what was latched since then stays.
/// @realtime  read, write, fault, clear: no allocation, no throw, no system call. All else is not for the loop
template <UsbProtocol P>
class UsbLink {
 public:
  using State = typename P::State;
  using Command = typename P::Command;
  using Reading = UsbReading<State>;

  /// Opens the device.
  /// @throws std::invalid_argument  where a setting cannot serve
  /// @throws UsbError               where no device, or more than one, can be opened
  explicit UsbLink(const UsbLinkSettings& settings = {}) : settings_{settings.checked()}, context_{make_usb_context()} {
    if (settings_.identities.empty()) settings_.identities.assign(P::identities.begin(), P::identities.end());
    open();
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }
  ~UsbLink() = default;
  UsbLink(const UsbLink&) = delete;
  UsbLink& operator=(const UsbLink&) = delete;
  UsbLink(UsbLink&&) = delete;
  UsbLink& operator=(UsbLink&&) = delete;

  /// By the loop. @param now  by `steady_now`
  [[nodiscard]] Reading read(Time now) noexcept {
    Reading reading;
    reading.fresh = states_.take();
    const Received& received = states_.value();
    reading.state = received.state;
    reading.stamp = received.stamp;
    reading.count = received.count;
    reading.opening = received.opening;
    told_ = latched_.load(std::memory_order_acquire);
    reading.fault = told_.number == cleared_ ? UsbFault::none : told_.reason;
    reading.status = when(received.count == 0, Status::no_sample) |
                     when(received.count > 0 && elapsed(now, received.stamp) > settings_.stale_after, Status::stale) |
                     when(!connected(), Status::disconnected) | when(told_.reason != UsbFault::none, Status::fault);
    return reading;
  }

  /// By the loop: to be sent; the newest replaces what was not sent yet.
  /// @return  disconnected, fault: it will not be sent
  Status write(const Command& command) noexcept {
    orders_.write({command, cleared_, true});
    return when(!connected(), Status::disconnected) | when(fault() != UsbFault::none, Status::fault);
  }

  /// By the loop: ends the fault that the last reading told of, deliberately, once its cause has gone; until then it
  /// comes again. Motors are off until the next command. Without such a fault nothing changes.
  void clear() noexcept {
    if (told_.reason == UsbFault::none || told_.number == cleared_) return;
    cleared_ = told_.number;
    orders_.write({P::safe(), cleared_, false});
  }

  [[nodiscard]] UsbFault fault() const noexcept { return latched_.load(std::memory_order_acquire).reason; }
  [[nodiscard]] bool connected() const noexcept { return connected_.load(std::memory_order_acquire); }
  /// Whether its thread was given the priority that was asked for; false before it has begun.
  [[nodiscard]] bool realtime() const noexcept { return realtime_.load(std::memory_order_acquire); }
  [[nodiscard]] const UsbCounters& counters() const noexcept { return counters_; }

 private:
  struct Received {
    State state{};
    Time stamp{};
    std::uint64_t count = 0;
    std::uint32_t opening = 0;
  };
  struct Latched {
    UsbFault reason = UsbFault::none;
    std::uint32_t number = 0;  // of faults up to this one, or to the last one
  };
  static_assert(std::atomic<Latched>::is_always_lock_free);
  struct Order {
    Command command = P::safe();
    std::uint32_t cleared = 0;  // number of the fault that the loop has cleared last
    bool live = false;          // whether it is the loop's, and not what `clear` leaves
  };

  void open() {
    const auto present = list_usb_devices(context_.get());
    auto handle = std::make_unique<UsbHandle>(choose_usb_device(present, settings_.identities, settings_.path),
                                              P::interface_number);
    handle->prepare(P::init());
    last_state_.reset();
    ++opening_;
    state_at_ = heard_at_ = steady_now();
    stream_ = std::make_unique<detail::UsbStream<P>>(context_.get(), std::move(handle), counters_,
                                                     [this](std::span<const std::byte> bytes) { receive(bytes); });
    arrived_ = 0;
    connected_.store(true, std::memory_order_release);
  }

  void serve(const std::stop_token& stop) noexcept {
    if (settings_.priority > 0) {
      const sched_param wanted{.sched_priority = settings_.priority};
      realtime_.store(::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &wanted) == 0, std::memory_order_release);
    }
    const auto poll = std::chrono::duration_cast<std::chrono::microseconds>(settings_.poll);
    while (!stop.stop_requested()) {
      if (!stream_) {
        search(stop);
        continue;
      }
      serving_ = true;
      stream_->handle_events(poll);
      serve_loop(steady_now());
      if (stream_->gone()) lose();
    }
    serving_ = false;
    if (stream_) leave();
    stream_.reset();
  }

  void serve_loop(Time now) noexcept {
    take_order(now);
    watch(now);
    send_due(now);
  }

  // Motors off, twice.
  void leave() noexcept {
    for (int time = 0; time < 2 && !stream_->gone(); ++time) {
      const Time end = steady_now() + std::chrono::milliseconds(50);
      bool sent = false;
      while ((!sent || !stream_->all_sent()) && !stream_->gone() && steady_now() < end) {
        sent = sent || stream_->send(P::encode(P::safe(), ++sequence_, settings_.device_watchdog));
        stream_->handle_events(std::chrono::microseconds(500));
      }
    }
  }

  // Whatever was wrong before, this is more.
  void lose() noexcept {
    connected_.store(false, std::memory_order_release);
    counters_.add(UsbCount::disconnects);
    latch(UsbFault::disconnected);
    renumber(UsbFault::disconnected);
    stream_.reset();
  }

  void search(const std::stop_token& stop) noexcept {
    const Time next = later(steady_now(), settings_.search_every);
    while (steady_now() < next) {
      if (stop.stop_requested()) return;
      std::this_thread::sleep_for(std::min<Duration>(settings_.search_every, std::chrono::milliseconds(10)));
    }
    timeval now{};
    (void)libusb_handle_events_timeout_completed(context_.get(), &now, nullptr);
    try {
      open();
    } catch (const std::exception&) {
      stream_.reset();  // not there yet, or not yet ours: again later
    }
    (void)orders_.take();  // what the loop wanted meanwhile
    renumber(UsbFault::disconnected);
  }

  void receive(std::span<const std::byte> bytes) noexcept {
    const auto frame = P::decode(bytes);
    if (frame.fault == FrameFault::empty) return;
    if (frame.fault != FrameFault::none) return counters_.add(UsbCount::damaged);
    const std::uint32_t steps = last_state_ ? P::steps(*last_state_, frame.state) : 1;
    if (steps == 0) return counters_.add(UsbCount::repeated);
    if (steps > backwards_from) {
      begin_anew();
    } else {
      counters_.add(UsbCount::lost, steps - 1);
    }
    counters_.add(UsbCount::states);
    last_state_ = frame.state;
    state_at_ = steady_now();
    states_.write({frame.state, state_at_, ++count_, opening_});
    // Here too: libusb may go from one event to the next for milliseconds before it returns.
    if (serving_ && stream_) serve_loop(state_at_);
  }

  // USB brings frames in their order: a device whose numbers go back has begun to count again.
  void begin_anew() noexcept {
    ++opening_;
    latch(UsbFault::power_cycled);
    renumber(UsbFault::power_cycled);
  }

  void take_order(Time now) noexcept {
    if (!orders_.take()) return;
    const Order& order = orders_.value();
    if (const Latched is = latched_.load(std::memory_order_relaxed);
        is.reason != UsbFault::none && order.cleared == is.number) {
      latched_.store({UsbFault::none, is.number}, std::memory_order_release);
      heard_at_ = now;  // the watch below latches again where nothing has changed
    }
    if (due_ && watching_ && fault() == UsbFault::none) counters_.add(UsbCount::dropped);  // the one before it
    ordered_at_ = now;
    watching_ = watching_ || order.live;
    due_ = true;
  }

  void watch(Time now) noexcept {
    if (stream_->arrived() != arrived_ || tried_at_ < heard_at_) {
      arrived_ = stream_->arrived();
      heard_at_ = now;
    }
    if (last_state_ && elapsed(now, state_at_) > settings_.stale_after) latch(UsbFault::stale);
    if (watching_ && elapsed(now, ordered_at_) > settings_.host_watchdog) latch(UsbFault::loop_silent);
    if (elapsed(now, heard_at_) > settings_.host_watchdog) latch(UsbFault::device_silent);
  }

  void latch(UsbFault reason) noexcept {
    if (fault() != UsbFault::none) return;
    counters_.add(UsbCount::faults);
    watching_ = false;  // from the next command on, again
    due_ = true;        // what takes the motors off
    renumber(reason);
  }

  // The fault is another one for the loop, which what it has cleared until now does not end.
  void renumber(UsbFault reason) noexcept {
    latched_.store({reason, latched_.load(std::memory_order_relaxed).number + 1}, std::memory_order_release);
  }

  // The loop's newest command, or what takes the motors off; that again and again, where there is none of the loop's.
  void send_due(Time now) noexcept {
    const bool allowed = fault() == UsbFault::none && watching_;
    const Duration again = P::polled ? std::chrono::milliseconds(1) : std::chrono::milliseconds(5);
    if (!due_ && (allowed && !P::polled)) return;
    if (!due_ && elapsed(now, sent_at_) < again) return;
    const Command& command = allowed ? orders_.value().command : safe_;
    tried_at_ = now;
    // Where both transfers are busy, again at the next poll, with what is the newest then.
    if (!stream_->send(P::encode(command, sequence_ + 1, settings_.device_watchdog))) return;
    if (due_ && !allowed && watching_) counters_.add(UsbCount::dropped);
    ++sequence_;
    sent_at_ = now;
    due_ = false;
  }

  static constexpr std::uint32_t backwards_from = 1U << 31U;

  UsbLinkSettings settings_;
  UsbCounters counters_;
  LatestValue<Received> states_;
  LatestValue<Order> orders_;
  std::atomic<Latched> latched_{};
  std::atomic<bool> connected_{false}, realtime_{false};

  // The loop's.
  Latched told_{};             // by the last reading
  std::uint32_t cleared_ = 0;  // number of the fault that it has cleared last

  // The thread's.
  UsbContext context_;
  std::unique_ptr<detail::UsbStream<P>> stream_;
  std::optional<State> last_state_;
  Command safe_ = P::safe();
  Time state_at_{}, ordered_at_{}, tried_at_{}, sent_at_{}, heard_at_{};
  std::uint64_t count_ = 0, arrived_ = 0;
  std::uint32_t sequence_ = 0, opening_ = 0;
  bool serving_ = false;   // neither ending nor before the first event
  bool watching_ = false;  // whether the loop has given a command since the last fault
  bool due_ = false;       // something new is to be sent

  std::jthread thread_;  // the last: it ends before what it uses
};

}  // namespace limpid
