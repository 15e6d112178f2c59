// SPDX-License-Identifier: MIT
#pragma once

#include "panel_screen.hpp"

#include <limpid/core/latest_value.hpp>
#include <limpid/core/time.hpp>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace limpid::examples {

struct TextPanelSettings {
  Duration period = std::chrono::milliseconds(100);  ///< between two drawings in a terminal, > 0
  Duration plain_period = std::chrono::seconds(1);   ///< between two plain lines, where there is no terminal, > 0
  int descriptor = STDOUT_FILENO;
};

/// Shows the newest values of a running loop in a few lines of a terminal, see PanelScreen; a thread of its own draws
/// them. The destructor draws the last ones and never waits for the terminal.
/// @tparam Values  what the loop has to show; assigning it does not throw, said or not
template <typename Values>
class TextPanel {
 public:
  using Lines = std::function<std::vector<std::string>(const Values&)>;

  /// @param lines  how values look; called by the panel's thread
  explicit TextPanel(Lines lines, const TextPanelSettings& settings = {})
      : lines_{std::move(lines)}, screen_(settings.descriptor) {
    const Duration period = screen_.in_place() ? settings.period : settings.plain_period;
    sigset_t all, mask;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &mask);  // signals are for others, and a closed pipe is no reason to die
    thread_ = std::jthread([this, period](const std::stop_token& stop) { serve(stop, period); });
    pthread_sigmask(SIG_SETMASK, &mask, nullptr);
  }
  TextPanel(const TextPanel&) = delete;
  TextPanel& operator=(const TextPanel&) = delete;

  /// By the loop.
  /// @realtime  no allocation, no throw, no system call
  void show(const Values& values) noexcept { latest_.write({values}); }

 private:
  // Eigen's vectors of fixed size do not throw, and do not say so.
  struct Held {
    Values values{};

    Held() = default;
    Held(const Values& of) : values{of} {}  // NOLINT(*-explicit-*): the same thing
    Held(const Held&) = default;
    Held& operator=(const Held& other) noexcept {  // NOLINT(*-unhandled-self-assignment): of its only member
      values = other.values;
      return *this;
    }
    ~Held() = default;
  };

  void serve(const std::stop_token& stop, Duration period) {
    std::mutex mutex;
    std::condition_variable_any wake;
    std::unique_lock lock(mutex);
    while (!stop.stop_requested()) {
      draw();
      wake.wait_for(lock, stop, period, [] { return false; });
    }
    draw();
  }

  void draw() {
    if (latest_.take()) screen_.draw(lines_(latest_.value().values));
  }

  Lines lines_;
  LatestValue<Held> latest_;
  PanelScreen screen_;
  std::jthread thread_;  // the last: it ends before what it uses
};

}  // namespace limpid::examples
