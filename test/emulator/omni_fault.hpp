// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace limpid::emulator {

/// What can be wrong with an EmulatedOmni.
enum class OmniFault {
  short_packet,        ///< 32 of a frame's bytes
  corrupt,             ///< one bit of a frame turned, its CRC as it was
  wrong_magic,         ///< another beginning, under a right CRC
  wrong_version,       ///< version 2, under a right CRC
  wrong_kind,          ///< not a state, under a right CRC
  stall_in,            ///< IN stalls, at once, until the host clears the halt
  stall_out,           ///< OUT stalls likewise
  babble,              ///< more bytes than the packet may have: EOVERFLOW
  protocol_error,      ///< EPROTO in place of a frame: a bad cable
  protocol_error_out,  ///< EPROTO in place of taking a command
  silence,             ///< no frame comes
  out_stuck,           ///< no command is taken, and its transfer does not end
  out_refused,         ///< the host's controller takes no transfer to it: ENOMEM
  lost,                ///< every third frame goes lost
  repeated,            ///< every frame comes twice
  stuck,               ///< one frame comes again and again
  frozen,              ///< counts that do not change, in frames that do
  absurd,              ///< counts that leap by some 5 rad and back
  slow,                ///< a frame every 5 ms
};

/// Their names, in order.
inline constexpr std::array<std::string_view, 19> fault_names{"short-packet",
                                                              "corrupt",
                                                              "wrong-magic",
                                                              "wrong-version",
                                                              "wrong-kind",
                                                              "stall-in",
                                                              "stall-out",
                                                              "babble",
                                                              "protocol-error",
                                                              "protocol-error-out",
                                                              "silence",
                                                              "out-stuck",
                                                              "out-refused",
                                                              "lost",
                                                              "repeated",
                                                              "stuck",
                                                              "frozen",
                                                              "absurd",
                                                              "slow"};

[[nodiscard]] inline std::optional<OmniFault> fault_named(std::string_view name) {
  for (std::size_t i = 0; i < fault_names.size(); ++i)
    if (fault_names[i] == name) return static_cast<OmniFault>(i);
  return std::nullopt;
}

/// Which faults there are, each for a number of frames or until it is taken away.
class OmniFaults {
 public:
  static constexpr int always = -1;

  void set(OmniFault fault, int frames) { left_[index(fault)] = frames; }
  void clear() { left_.fill(0); }
  [[nodiscard]] bool has(OmniFault fault) const { return left_[index(fault)] != 0; }
  /// One frame, or what would have been one, is over.
  void count_frame() {
    for (int& left : left_)
      if (left > 0) --left;
  }

 private:
  static std::size_t index(OmniFault fault) { return static_cast<std::size_t>(fault); }
  std::array<int, fault_names.size()> left_{};
};

}  // namespace limpid::emulator
