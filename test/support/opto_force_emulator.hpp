// SPDX-License-Identifier: MIT
#pragma once

#include <support/opto_force_bytes.hpp>
#include <support/serial_line.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace limpid::test {

/// An OptoForce sensor that lives behind a pseudo-terminal: sends frames 1 to 3 ms apart, answers configurations, and
/// does wrong what it is told to. All calls by any thread.
class OptoForceEmulator {
 public:
  OptoForceEmulator() : sender_{[this] { run(); }} {}
  ~OptoForceEmulator() {
    stop_ = true;
    sender_.join();
  }
  OptoForceEmulator(const OptoForceEmulator&) = delete;
  OptoForceEmulator& operator=(const OptoForceEmulator&) = delete;

  [[nodiscard]] const std::string& path() const { return terminal_.path(); }

  void feel(const std::array<int, 3>& counts) {
    with_lock([&] { counts_ = counts; });
  }
  void say(unsigned status) {
    with_lock([&] { status_ = status; });
  }
  void stall(bool stalled) {
    with_lock([&] { stalled_ = stalled; });
  }
  void answer(std::optional<std::uint8_t> error) {
    with_lock([&] { answer_ = error; });
  }  ///< none: does not
  void corrupt(int frames) {
    with_lock([&] { corrupt_ += frames; });
  }  ///< of the next ones
  void lose(int frames) {
    with_lock([&] { number_ += static_cast<unsigned>(frames); });
  }
  void send(const Bytes& garbage) {
    with_lock([&] { terminal_.send(garbage); });
  }
  void unplug() {
    with_lock([&] { terminal_.unplug(); });
  }
  void plug_in() {
    with_lock([&] { terminal_.plug_in(); });
  }

  /// Configurations that came whole.
  [[nodiscard]] std::vector<Bytes> configurations() {
    const std::lock_guard lock(mutex_);
    return configurations_;
  }

 private:
  template <typename F>
  void with_lock(F&& change) {
    const std::lock_guard lock(mutex_);
    change();
  }

  void run() {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> microseconds(1000, 3000);
    while (!stop_) {
      with_lock([&] {
        listen();
        if (!stalled_ && terminal_.waiting() < 1000) send_frame();  // none is lost because the reader is slow
      });
      std::this_thread::sleep_for(std::chrono::microseconds(microseconds(random)));
    }
  }

  void send_frame() {
    Bytes bytes = frame_bytes(number_++ % 65536, status_, counts_);
    if (corrupt_ > 0) {
      --corrupt_;
      bytes[12] = static_cast<std::uint8_t>(bytes[12] ^ 0x40);
    }
    terminal_.send(bytes);
  }

  void listen() {
    const Bytes more = terminal_.receive();
    heard_.insert(heard_.end(), more.begin(), more.end());
    const Bytes head{0xAA, 0x00, 0x32, 0x03};
    while (heard_.size() >= 9) {
      const Bytes command(heard_.begin(), heard_.begin() + 9);
      const bool whole = std::equal(head.begin(), head.end(), command.begin()) &&
                         with_checksum(Bytes(command.begin(), command.begin() + 7)) == command;
      heard_.erase(heard_.begin(), heard_.begin() + (whole ? 9 : 1));
      if (!whole) continue;
      configurations_.push_back(command);
      if (answer_) terminal_.send(answer_bytes(*answer_));
    }
  }

  std::mutex mutex_;
  SerialLine terminal_;
  std::array<int, 3> counts_{};
  unsigned status_ = 0, number_ = 65000;
  bool stalled_ = false;
  std::optional<std::uint8_t> answer_ = std::uint8_t{0};
  int corrupt_ = 0;
  Bytes heard_;
  std::vector<Bytes> configurations_;
  std::atomic<bool> stop_{false};
  std::thread sender_;
};

}  // namespace limpid::test
