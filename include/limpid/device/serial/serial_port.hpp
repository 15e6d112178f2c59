// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/expect.hpp>
#include <limpid/core/time.hpp>
#include <limpid/device/serial/byte_port.hpp>

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/serial_port.hpp>
#include <boost/asio/write.hpp>
#include <boost/system/error_code.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include <termios.h>

namespace limpid {

/// A serial line of the operating system, raw, eight bits, through Boost.Asio: /dev/ttyACM0, or a pseudo-terminal.
/// What waited there when it was opened is dropped.
class SerialPort {
 public:
  struct Settings {
    std::string device{};                                     ///< its path
    unsigned baud = 115200;                                   ///< of no matter to a USB device of class CDC-ACM
    Duration longest_write = std::chrono::milliseconds(200);  ///< > 0
  };

  /// Does not open it yet.
  /// @throws std::invalid_argument        where the settings cannot serve
  /// @throws boost::system::system_error  where the system has no more descriptors for waiting
  explicit SerialPort(Settings settings) : settings_{std::move(settings)}, line_{std::make_unique<Line>()} {
    expect(!settings_.device.empty(), "SerialPort: device", "a path", "an empty one");
    expect(settings_.baud > 0, "SerialPort: baud", "> 0", settings_.baud);
    expect(settings_.longest_write > Duration::zero(), "SerialPort: longest_write", "> 0", settings_.longest_write);
  }

  [[nodiscard]] bool open() noexcept {
    close();
    try {
      Error error;
      (void)line_->port.open(settings_.device, error);
      if (error) return false;
      (void)line_->port.set_option(boost::asio::serial_port::baud_rate(settings_.baud), error);
      if (!error) ::tcflush(line_->port.native_handle(), TCIOFLUSH);
      if (error) close();
      return !error;
    } catch (const std::exception&) {
      close();
      return false;
    }
  }

  [[nodiscard]] PortRead read(std::span<std::uint8_t> into, Duration longest) noexcept {
    return finish(longest, [&](auto&& done) {
      line_->port.async_read_some(boost::asio::buffer(into.data(), into.size()), std::forward<decltype(done)>(done));
    });
  }

  [[nodiscard]] bool write(std::span<const std::uint8_t> bytes) noexcept {
    const PortRead written = finish(settings_.longest_write, [&](auto&& done) {
      boost::asio::async_write(line_->port, boost::asio::buffer(bytes.data(), bytes.size()),
                               std::forward<decltype(done)>(done));
    });
    return written.open && written.bytes == bytes.size();
  }

  void close() noexcept {
    Error ignored;
    if (line_->port.is_open()) (void)line_->port.close(ignored);
  }

  [[nodiscard]] const Settings& settings() const noexcept { return settings_; }

 private:
  using Error = boost::system::error_code;

  struct Line {  // where it stays when the port is moved
    boost::asio::io_context context{1};
    boost::asio::serial_port port{context};
    PortRead result{};  // of the operation that runs
    bool cancelled = false;
  };

  // Starts an operation and waits for its end, no longer than `longest`.
  template <typename Start>
  PortRead finish(Duration longest, const Start& start) noexcept {
    if (!line_->port.is_open()) return {.open = false};
    try {
      Line& line = *line_;
      line.result = {.open = false};
      line.cancelled = false;
      start([&line](const Error& error, std::size_t bytes) {
        line.result.bytes = bytes;
        line.result.open = !error || (line.cancelled && error == boost::asio::error::operation_aborted);
      });
      line.context.restart();
      line.context.run_for(longest);
      if (!line.context.stopped()) {
        line.cancelled = true;
        Error ignored;
        (void)line.port.cancel(ignored);
        line.context.run();
      }
      return line.result;
    } catch (const std::exception&) {
      close();
      return {.open = false};
    }
  }

  Settings settings_;
  std::unique_ptr<Line> line_;
};

static_assert(BytePort<SerialPort>);

}  // namespace limpid
