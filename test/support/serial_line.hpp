// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace limpid::test {

/// One end of a line whose other end is a serial port, found by a path that stays when it is plugged in again.
class SerialLine {
 public:
  SerialLine() : path_{unique_path()} { plug_in(); }
  ~SerialLine() {
    unplug();
    std::filesystem::remove(path_);
  }
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] bool plugged_in() const { return master_ >= 0; }

  void plug_in() {
    if (plugged_in()) return;
    master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    std::array<char, 100> name{};
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0 ||
        ::ptsname_r(master_, name.data(), name.size()) != 0) {
      throw std::runtime_error("no pseudo-terminal to be had");
    }
    // Held open, so that the line keeps its settings whoever comes and goes.
    slave_ = ::open(name.data(), O_RDWR | O_NOCTTY);
    termios raw{};
    ::tcgetattr(slave_, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(slave_, TCSANOW, &raw);
    const std::string next = path_ + ".next";
    std::filesystem::create_symlink(name.data(), next);
    std::filesystem::rename(next, path_);
  }

  void unplug() {
    if (!plugged_in()) return;
    std::filesystem::remove(path_);
    ::close(slave_);
    ::close(master_);
    master_ = slave_ = -1;
  }

  /// What has come; empty where nothing has.
  std::vector<std::uint8_t> receive() {
    std::vector<std::uint8_t> bytes(256);
    const ssize_t got = plugged_in() ? ::read(master_, bytes.data(), bytes.size()) : 0;
    bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return bytes;
  }

  /// Bytes sent that nobody has read.
  [[nodiscard]] int waiting() const {
    int bytes = 0;
    if (plugged_in()) (void)::ioctl(slave_, FIONREAD, &bytes);
    return bytes;
  }

  /// What does not fit, since nobody reads, is dropped.
  void send(const std::vector<std::uint8_t>& bytes) {
    if (plugged_in()) (void)!::write(master_, bytes.data(), bytes.size());
  }

 private:
  static std::string unique_path() {
    static std::atomic<int> count{0};
    return (std::filesystem::temp_directory_path() /
            ("limpid_tty_" + std::to_string(::getpid()) + '_' + std::to_string(count++)))
        .string();
  }

  std::string path_;
  int master_ = -1, slave_ = -1;
};

}  // namespace limpid::test
