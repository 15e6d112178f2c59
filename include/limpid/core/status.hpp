// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace limpid {

/// What a hot call has to say about its inputs and its answer; joined by `|` over the blocks of a tick.
enum class Status : std::uint32_t {
  ok = 0,
  not_finite = 1U << 0,       ///< an input was NaN or infinite: the last good value was used
  clock_backwards = 1U << 1,  ///< time did not advance: the call changed nothing
  no_sample = 1U << 2,        ///< nothing has arrived yet: the initial value was used
  out_of_order = 1U << 3,     ///< a sample not newer than the newest one was dropped
  out_of_history = 1U << 4,  ///< an instant outside the stored history: the nearest entry was used, or a sample dropped
  overflow = 1U << 5,        ///< a fixed store was full: the oldest entry was dropped
  singular = 1U << 6,        ///< a pose at or near a singularity: a bounded answer was used
  unreachable = 1U << 7,     ///< a target outside the workspace: the nearest reachable one was used
  at_bound = 1U << 8,        ///< a parameter or a scheduled gain was held on its bound
  limited = 1U << 9,         ///< a torque was reduced to its limit or its slew rate
  joint_limit = 1U << 10,    ///< torque toward a near joint limit was removed
  workspace_limit = 1U << 11,  ///< torque toward the edge of the workspace was removed
  fault = 1U << 12,            ///< a latched fault: zero torque until a deliberate reset
  disconnected = 1U << 13,     ///< the device does not answer
  stale = 1U << 14,            ///< the newest data are older than allowed
  coarse = 1U << 15,           ///< a step too long for what it follows: taken damped, of order 1
  lost = 1U << 16,             ///< a prediction far from what was measured: it started again from the newest sample
  overload = 1U << 17,         ///< a sensor loaded beyond its range: there was more than its value says
};

[[nodiscard]] constexpr Status operator|(Status a, Status b) noexcept {
  return static_cast<Status>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}

[[nodiscard]] constexpr Status operator&(Status a, Status b) noexcept {
  return static_cast<Status>(static_cast<std::uint32_t>(a) & static_cast<std::uint32_t>(b));
}

constexpr Status& operator|=(Status& a, Status b) noexcept { return a = a | b; }

/// Whether any bit of `which` is set in `status`.
[[nodiscard]] constexpr bool has(Status status, Status which) noexcept { return (status & which) != Status::ok; }

/// `bit` where `condition` holds, else `ok`: keeps a hot path free of branches.
[[nodiscard]] constexpr Status when(bool condition, Status bit) noexcept {
  return static_cast<Status>(static_cast<std::uint32_t>(bit) * static_cast<std::uint32_t>(condition));
}

/// "not_finite, singular", or "ok"; for people, not for the loop (allocates).
[[nodiscard]] inline std::string describe(Status status) {
  constexpr std::array<std::pair<Status, std::string_view>, 18> names{{
      {Status::not_finite, "not_finite"},
      {Status::clock_backwards, "clock_backwards"},
      {Status::no_sample, "no_sample"},
      {Status::out_of_order, "out_of_order"},
      {Status::out_of_history, "out_of_history"},
      {Status::overflow, "overflow"},
      {Status::singular, "singular"},
      {Status::unreachable, "unreachable"},
      {Status::at_bound, "at_bound"},
      {Status::limited, "limited"},
      {Status::joint_limit, "joint_limit"},
      {Status::workspace_limit, "workspace_limit"},
      {Status::fault, "fault"},
      {Status::disconnected, "disconnected"},
      {Status::stale, "stale"},
      {Status::coarse, "coarse"},
      {Status::lost, "lost"},
      {Status::overload, "overload"},
  }};
  std::string text;
  for (const auto& [bit, name] : names) {
    if (!has(status, bit)) continue;
    if (!text.empty()) text += ", ";
    text += name;
  }
  return text.empty() ? "ok" : text;
}

}  // namespace limpid
