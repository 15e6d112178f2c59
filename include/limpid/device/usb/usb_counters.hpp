// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace limpid {

/// What a UsbLink counts from its start on.
enum class UsbCount : std::size_t {
  states,      ///< new and whole
  lost,        ///< states that the device numbered and that never came
  repeated,    ///< states that came again: dropped
  damaged,     ///< frames with another length, header or checksum, or with values that cannot be: dropped
  in_errors,   ///< transfers from the device that failed
  out_errors,  ///< transfers to it that failed or took too long
  commands,    ///< sent, and arrived
  dropped,  ///< commands of the loop that a newer one replaced before it went, or that came while a fault was latched
  halts,    ///< of an endpoint, cleared
  disconnects,  ///< the device went away
  faults,       ///< latched
};

/// One thread counts, any may look.
class UsbCounters {
 public:
  void add(UsbCount what, std::uint64_t number = 1) noexcept { at(what).fetch_add(number, std::memory_order_relaxed); }

  [[nodiscard]] std::uint64_t operator[](UsbCount what) const noexcept {
    return counts_[static_cast<std::size_t>(what)].load(std::memory_order_relaxed);
  }

 private:
  std::atomic<std::uint64_t>& at(UsbCount what) noexcept { return counts_[static_cast<std::size_t>(what)]; }

  std::array<std::atomic<std::uint64_t>, static_cast<std::size_t>(UsbCount::faults) + 1> counts_{};
};

}  // namespace limpid
