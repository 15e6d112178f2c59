// SPDX-License-Identifier: MIT
#pragma once

#include <sys/fsuid.h>
#include <unistd.h>

namespace limpid::emulator {

/// While it lives, this thread, and those that it starts meanwhile, open files as nobody does: root, for whom modes
/// mean nothing, puts that right off for its files alone. Others are who they are.
class WithoutRights {
 public:
  WithoutRights() : group_{::setfsgid(nobody)}, user_{::setfsuid(nobody)} {}
  ~WithoutRights() {
    ::setfsuid(static_cast<uid_t>(user_));
    ::setfsgid(static_cast<gid_t>(group_));
  }
  WithoutRights(const WithoutRights&) = delete;
  WithoutRights& operator=(const WithoutRights&) = delete;

  /// Whether the process is no root, so that a mode of 0600 denies it nothing: make it 0.
  static bool only_by_mode() { return ::geteuid() != 0; }

 private:
  static constexpr unsigned nobody = 65534;
  int group_, user_;
};

}  // namespace limpid::emulator
