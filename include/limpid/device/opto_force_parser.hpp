// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/opto_force_protocol.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace limpid {

/// Finds the frames and answers of an OptoForce sensor in the bytes that come, in pieces of any length, from anywhere
/// in a frame, with anything in between. Where a checksum is wrong, only the first byte is given up: a frame that began
/// within is found.
///
/// Of the bytes taken, 16 belong to each frame, 7 to each answer, `skipped` to neither, and at most 15 wait for the
/// next call.
/// @realtime  no allocation, no throw; a byte costs a few comparisons, and where it is skipped a move of at most 15
class OptoForceParser {
 public:
  struct Counters {
    std::uint64_t frames = 0;         ///< good ones
    std::uint64_t lost = 0;           ///< numbers missing between good frames, those with wrong checksums among them
    std::uint64_t restarts = 0;       ///< frames whose number is not ahead of the one before, or by half the range
    std::uint64_t bad_checksums = 0;  ///< of what began like a frame or an answer
    std::uint64_t skipped = 0;        ///< bytes of no frame and no answer
  };

  /// @param on_frame   on_frame(const OptoForceFrame&), for each good frame in order
  /// @param on_answer  on_answer(const OptoForceAnswer&)
  template <typename OnFrame, typename OnAnswer>
  void take(std::span<const std::uint8_t> bytes, OnFrame&& on_frame, OnAnswer&& on_answer) noexcept {
    static_assert(std::is_nothrow_invocable_v<OnFrame&, const OptoForceFrame&>);
    static_assert(std::is_nothrow_invocable_v<OnAnswer&, const OptoForceAnswer&>);
    for (const std::uint8_t byte : bytes) {
      packet_[length_++] = byte;
      while (length_ > 0 && (!can_begin() || length_ >= size())) {
        if (!can_begin()) {
          skip();
        } else if (!is_sound()) {
          ++counters_.bad_checksums;
          skip();
        } else if (is_frame()) {
          on_frame(frame());
          remove(frame_size);
        } else {
          on_answer(OptoForceAnswer{packet_[4]});
          remove(answer_size);
        }
      }
    }
  }

  /// Since the beginning.
  [[nodiscard]] const Counters& counters() const noexcept { return counters_; }

  /// The next byte comes from another connection: what is incomplete is skipped, the next number follows none.
  void reconnect() noexcept {
    counters_.skipped += length_;
    length_ = 0;
    numbered_ = false;
  }

 private:
  using Head = std::array<std::uint8_t, 4>;
  static constexpr Head frame_head{0xAA, 0x07, 0x08, 0x0A}, answer_head{0xAA, 0x00, 0x50, 0x01};
  static constexpr std::size_t frame_size = 16, answer_size = 7;

  [[nodiscard]] bool begins_like(const Head& head) const noexcept {
    return std::equal(head.begin(), head.begin() + static_cast<std::ptrdiff_t>(std::min(length_, head.size())),
                      packet_.begin());
  }
  [[nodiscard]] bool can_begin() const noexcept { return begins_like(frame_head) || begins_like(answer_head); }
  [[nodiscard]] bool is_frame() const noexcept { return begins_like(frame_head); }
  [[nodiscard]] std::size_t size() const noexcept { return is_frame() ? frame_size : answer_size; }

  void remove(std::size_t bytes) noexcept {
    std::copy(packet_.begin() + static_cast<std::ptrdiff_t>(bytes), packet_.end(), packet_.begin());
    length_ -= bytes;
  }

  void skip() noexcept {
    remove(1);
    ++counters_.skipped;
  }

  [[nodiscard]] std::uint16_t word(std::size_t at) const noexcept {
    return static_cast<std::uint16_t>(packet_[at] << 8U | packet_[at + 1]);
  }

  [[nodiscard]] bool is_sound() const noexcept {
    unsigned sum = 0;
    const std::size_t end = size() - 2;
    for (std::size_t i = 0; i < end; ++i) sum += packet_[i];
    return sum == word(end);
  }

  OptoForceFrame frame() noexcept {
    OptoForceFrame frame{.number = word(4), .status = word(6)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      frame.counts[axis] = static_cast<std::int16_t>(word(8 + 2 * axis));
    }
    const auto ahead = static_cast<std::uint16_t>(frame.number - number_);
    const bool follows = ahead != 0 && ahead < 0x8000U;
    if (numbered_ && follows) counters_.lost += ahead - 1U;
    if (numbered_ && !follows) ++counters_.restarts;
    number_ = frame.number;
    numbered_ = true;
    ++counters_.frames;
    return frame;
  }

  std::array<std::uint8_t, frame_size> packet_{};
  std::size_t length_ = 0;    // of what is in packet_, a beginning of a frame or an answer
  std::uint16_t number_ = 0;  // of the last frame
  bool numbered_ = false;     // whether there was one
  Counters counters_;
};

}  // namespace limpid
