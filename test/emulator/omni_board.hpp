// SPDX-License-Identifier: MIT
#pragma once

#include "omni_wire.hpp"

#include <limpid/core/time.hpp>

#include <array>
#include <cstdint>
#include <optional>

namespace limpid::emulator {

/// The bridge's firmware: which commands it takes, and when the motors have torque. Its clock is that of the arm.
class OmniBoard {
 public:
  static constexpr std::uint16_t zero_dac = 0x7ff;
  using Dac = std::array<std::uint16_t, 3>;

  /// After a power-up: no command yet, motors off.
  void power_up() { *this = OmniBoard{}; }

  /// Whether the packet is a valid command. It counts from `now` on.
  bool take(Time now, std::span<const std::uint8_t> packet) {
    const auto command = decode(packet);
    if (!command || !is_new(now, command->sequence)) return false;
    last_ = command;
    last_time_ = now;
    late_ = false;
    if (!command->motors_on()) refusing_ = false;
    return true;
  }

  /// The watchdog at `now`; true where it trips.
  bool watch(Time now) {
    if (!last_ || late_ || now - last_time_ < std::chrono::milliseconds(last_->watchdog)) return false;
    late_ = refusing_ = true;
    return true;
  }

  [[nodiscard]] bool motors_on() const { return wants_motors() && !late_ && !refusing_; }
  [[nodiscard]] bool wants_motors() const { return last_ && last_->motors_on(); }  ///< the last command does
  [[nodiscard]] Dac dac() const { return motors_on() ? last_->dac : Dac{zero_dac, zero_dac, zero_dac}; }
  [[nodiscard]] std::optional<OmniCommand> last() const { return last_; }

  [[nodiscard]] std::uint16_t flags() const {
    return static_cast<std::uint16_t>((late_ ? watchdog_has_motors_off : 0U) | (refusing_ ? commands_refused : 0U));
  }

 private:
  // Newer than the last; any after a second without.
  [[nodiscard]] bool is_new(Time now, std::uint32_t sequence) const {
    if (!last_ || now - last_time_ >= std::chrono::seconds(1)) return true;
    return static_cast<std::int32_t>(sequence - last_->sequence) > 0;
  }

  std::optional<OmniCommand> last_{};
  Time last_time_{};
  bool late_ = false, refusing_ = false;
};

}  // namespace limpid::emulator
