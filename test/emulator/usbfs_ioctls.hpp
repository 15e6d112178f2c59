// SPDX-License-Identifier: MIT
#pragma once

#include "usbfs.hpp"

#include <umockdev.h>

#include <memory>

namespace limpid::emulator {

/// Lets umockdev call `usbfs` for what clients ask of a device node. The handler keeps it alive as long as a client has
/// the node open.
[[nodiscard]] std::shared_ptr<UMockdevIoctlBase> serve(const std::shared_ptr<Usbfs>& usbfs);

}  // namespace limpid::emulator
