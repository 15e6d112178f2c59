// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace limpid::emulator {

/// The file that stands for a device node. A client may poll it for POLLOUT as usbfs has it: while a transfer can be
/// reaped. It is a FIFO with one slot, which is full while none can; a plain file would always be ready.
class UsbfsNode {
 public:
  /// @throws std::system_error  where the FIFO cannot be made
  UsbfsNode(std::string path, unsigned mode);
  ~UsbfsNode();
  UsbfsNode(const UsbfsNode&) = delete;
  UsbfsNode& operator=(const UsbfsNode&) = delete;

  /// Whether a client's poll finds it ready. Not thread-safe.
  void set_ready(bool ready);

  void remove();  ///< nobody can open it any more; who has it open may go on polling

 private:
  std::string path_;
  int file_ = -1;
  bool ready_ = true;
};

}  // namespace limpid::emulator
