// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>

#include <semaphore.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

namespace limpid {

/// Lets SIGINT and SIGTERM request a stop, as long as it lives; then the earlier handlers are back.
/// ```cpp
/// std::stop_source stop;
/// const StopOnSignal on_signal(stop);
/// loop.run(stop.get_token(), tick);
/// ```
/// The handler notes the signal and wakes a thread that requests the stop, which a handler must not do itself. After
/// the first signal the next one does what it does by default: who does not want to wait presses Ctrl-C again.
///
/// One at a time. The handler is async-signal-safe; system calls that can go on after it do (SA_RESTART).
class StopOnSignal {
 public:
  static constexpr std::size_t most = 8;  ///< signals

  /// @throws std::invalid_argument  for a signal that cannot be handled, for more than `most`, or while there is
  /// another
  explicit StopOnSignal(std::stop_source stop, const std::vector<int>& signals = {SIGINT, SIGTERM}) {
    expect(signals.size() <= most, "StopOnSignal: signals", "at most 8", signals.size());
    expect(!exists_.exchange(true), "StopOnSignal", "no other one at that time", "another");
    static const int made = sem_init(&heard_, 0, 0);
    while (made == 0 && sem_trywait(&heard_) == 0) {  // of an earlier one
    }
    signal_ = 0;
    for (const int signal : signals) {
      if (handle(signal)) continue;
      restore();
      expect(false, "StopOnSignal: signals", "such as can be handled", signal);
    }
    start(std::move(stop));
  }

  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;
  StopOnSignal(StopOnSignal&&) = delete;
  StopOnSignal& operator=(StopOnSignal&&) = delete;

  ~StopOnSignal() {
    sem_post(&heard_);
    thread_.join();
    restore();
  }

  /// The signal that came; 0 while none has.
  [[nodiscard]] int signal() const noexcept { return signal_; }  // NOLINT(*-to-static): of this one

 private:
  // Only what is lock-free, and sem_post, is safe in a handler.
  static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::size_t>::is_always_lock_free);
  static void on_signal(int signal) noexcept {
    const int error = errno;
    struct sigaction by_default {};
    by_default.sa_handler = SIG_DFL;
    for (std::size_t i = 0; i < count_; ++i) sigaction(handled_[i], &by_default, nullptr);
    signal_ = signal;
    sem_post(&heard_);
    errno = error;
  }

  bool handle(int signal) {
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigfillset(&action.sa_mask);
    const std::size_t at = count_;
    if (sigaction(signal, nullptr, &earlier_[at]) != 0) return false;
    handled_[at] = signal;
    count_ = at + 1;  // before the handler may run
    if (sigaction(signal, &action, nullptr) == 0) return true;
    count_ = at;
    return false;
  }

  void restore() {
    for (std::size_t i = count_; i > 0; --i) sigaction(handled_[i - 1], &earlier_[i - 1], nullptr);
    count_ = 0;
    exists_ = false;
  }

  // With all signals blocked: they are for others.
  void start(std::stop_source stop) {
    sigset_t all, mask;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &mask);
    thread_ = std::thread([stop = std::move(stop)]() mutable {
      while (sem_wait(&heard_) != 0 && errno == EINTR) {
      }
      if (signal_ != 0) stop.request_stop();
    });
    pthread_sigmask(SIG_SETMASK, &mask, nullptr);
  }

  // What a handler can reach. NOLINTBEGIN(*-non-const-global-variables)
  static inline sem_t heard_{};
  static inline std::atomic<bool> exists_ = false;
  static inline std::atomic<int> signal_ = 0;
  static inline std::array<int, most> handled_{};
  static inline std::atomic<std::size_t> count_ = 0;
  // NOLINTEND(*-non-const-global-variables)

  std::array<struct sigaction, most> earlier_{};
  std::thread thread_;
};

}  // namespace limpid
