// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace limpid::emulator {

/// A program that sees the emulated bus of this process: libumockdev-preload is loaded into it. Killed with its end.
class ChildProcess {
 public:
  /// @throws std::system_error  where it cannot be started
  explicit ChildProcess(const std::vector<std::string>& arguments);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  void signal(int number) const;
  /// Its exit code, or 128 and the signal that ended it; nothing while it runs.
  [[nodiscard]] std::optional<int> ended();
  [[nodiscard]] pid_t id() const { return id_; }

 private:
  pid_t id_ = -1;
  std::optional<int> code_{};
};

}  // namespace limpid::emulator
