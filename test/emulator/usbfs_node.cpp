// SPDX-License-Identifier: MIT
#include "usbfs_node.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

namespace limpid::emulator {
namespace {

int checked(int answer, const std::string& what) {
  if (answer < 0) throw std::system_error(errno, std::generic_category(), what);
  return answer;
}

}  // namespace

UsbfsNode::UsbfsNode(std::string path, unsigned mode) : path_{std::move(path)} {
  std::filesystem::create_directories(std::filesystem::path(path_).parent_path());
  checked(::mkfifo(path_.c_str(), 0600), path_);
  file_ = checked(::open(path_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC), path_);
  checked(::fcntl(file_, F_SETPIPE_SZ, 4096), path_ + ": F_SETPIPE_SZ");
  checked(::chmod(path_.c_str(), mode), path_);
  set_ready(false);
}

UsbfsNode::~UsbfsNode() {
  remove();
  ::close(file_);
}

void UsbfsNode::remove() {
  if (!path_.empty()) ::unlink(path_.c_str());
  path_.clear();
}

void UsbfsNode::set_ready(bool ready) {
  if (ready == ready_) return;
  char slot = 0;
  const auto moved = ready ? ::read(file_, &slot, 1) : ::write(file_, &slot, 1);
  if (moved == 1) ready_ = ready;
}

}  // namespace limpid::emulator
