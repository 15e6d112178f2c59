// SPDX-License-Identifier: MIT
#pragma once

#include "usb_settings.hpp"

#include <libusb.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace limpid::emulator {

/// Plain libusb, for tests of the emulator alone: asynchronous transfers, a thread for events, and every end of an IN
/// transfer in a queue.
class PlainClient {
 public:
  struct End {
    libusb_transfer_status status;
    Bytes bytes;
  };

  PlainClient() { libusb_init(&context_); }
  ~PlainClient() {
    close();
    libusb_exit(context_);
  }
  PlainClient(const PlainClient&) = delete;
  PlainClient& operator=(const PlainClient&) = delete;

  /// Opens the first device with these ids; 0, or libusb's error.
  int open(std::uint16_t vendor, std::uint16_t product, const char* path = nullptr);
  int claim() { return libusb_claim_interface(handle_, 0); }
  int claim_from_driver() {
    libusb_set_auto_detach_kernel_driver(handle_, 1);
    return claim();
  }
  void close();

  /// Keeps `count` IN transfers going.
  void stream(std::uint8_t endpoint = 0x81, int count = 4, std::uint8_t flags = 0);
  void stop();  ///< cancels what goes
  /// The next end of an IN transfer; nothing after 2 s.
  std::optional<End> next();
  /// Ends from now on that satisfy `wanted`, at most 4000 looked at.
  std::optional<End> find(const std::function<bool(const End&)>& wanted);
  /// Sends and waits; 0, or libusb's error. Not libusb's synchronous call, whose end the thread sanitizer cannot see.
  int send(Bytes bytes, unsigned timeout_ms = 500, std::uint8_t endpoint = 0x01);

  [[nodiscard]] libusb_device_handle* handle() const { return handle_; }
  [[nodiscard]] libusb_context* context() const { return context_; }

 private:
  struct In {
    PlainClient* client;
    libusb_transfer* transfer;
    std::array<std::uint8_t, 64> buffer;
  };

  struct Out {
    PlainClient* client;
    std::optional<libusb_transfer_status> status{};
  };

  static void LIBUSB_CALL sent(libusb_transfer* transfer);
  static void LIBUSB_CALL ended(libusb_transfer* transfer);
  void run();

  libusb_context* context_ = nullptr;
  libusb_device_handle* handle_ = nullptr;
  std::deque<std::unique_ptr<In>> ins_;
  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<End> ends_;
  int going_ = 0;  // transfers
  std::atomic<bool> running_{false}, again_{false};
  std::thread thread_;
};

/// "bus-port.port" of a device.
std::string path_of(libusb_device* device);

}  // namespace limpid::emulator
