// SPDX-License-Identifier: MIT
#pragma once

#include "prediction/trace.hpp"

#include <limpid/core/status.hpp>

namespace limpid::bench {

/// An Omni and how it is made to follow.
enum class Follower {
  ideal,             ///< ideal arm, SlotineLiAdaptive at the thesis's gains
  compensated,       ///< realistic arm, CompensatedTracking
  compensated_slow,  ///< the same for long periods
  best_of_hold       ///< realistic arm, SlotineLiAdaptive at the gains for which a search found hold's smallest error
};

/// What the tip makes of a wanted motion; errors are those of (x, v) from the true tool.
struct Press {
  double l2 = 0, late = 0;     ///< over the run; from `late_seconds` on
  double peak = 0;             ///< the largest
  double chatter = 0;          ///< mean |change of a joint's torque| a tick, N m
  double limited = 0;          ///< share of the ticks in which the limiter took torque away
  double motion = 0;           ///< of the joint that moves most, in the last `rest_seconds`, rad
  Status status = Status::ok;  ///< of the limiter, joined

  /// Whether the limiter had to keep the arm from a joint's end or the workspace's.
  [[nodiscard]] bool out_of_reach() const {
    return has(status, Status::fault) || has(status, Status::joint_limit) || has(status, Status::workspace_limit);
  }
};
inline constexpr double rest_seconds = 4;

/// Presses along x from where the arm starts; the operator's force acts on tool and arm.
/// @param wanted  a point for each tick of the truth
[[nodiscard]] Press press(const Truth& truth, const Trace& wanted, Follower follower);

}  // namespace limpid::bench
