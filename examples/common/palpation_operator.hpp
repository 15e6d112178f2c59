// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <limpid/device/simulated_omni.hpp>
#include <limpid/environment/operator_hand.hpp>

#include <optional>

namespace limpid::examples {

/// Who presses: the scene's force as it is, or its hand, which intends that force and feels the tip.
class PalpationOperator {
 public:
  /// @param wall  the wall's place along the press axis, m
  PalpationOperator(const Scene& scene, double wall);

  /// F_h at `now` along the press axis, N, on a device that has not yet moved to `now`.
  ///
  /// A hand's force is felt by the arm, and the arm by the hand. An ideal arm answers to a force from the next tick on,
  /// so that trying the tick once gives the true force. On a realistic one the force at `now` bends the tick's end by
  /// some B h/(2 m) of itself; four tries leave the fourth power of that, 0.4 % at the largest B that `palpate` takes
  /// with a hand of 0.2 kg.
  [[nodiscard]] double press(Time now, const SimulatedOmni<>& device);

  [[nodiscard]] Status status() const noexcept { return status_; }  ///< of the last `press`
  [[nodiscard]] HandEnergy<> energy() const;                        ///< zero without a hand

 private:
  [[nodiscard]] OperatorHand<1>::Output hold(OperatorHand<1>& hand, Time now, const SimulatedOmni<>& device) const;

  const Scene& scene_;
  double wall_;
  std::optional<OperatorHand<1>> hand_;
  double force_ = 0;  // F_h at the last tick
  Status status_ = Status::ok;
};

}  // namespace limpid::examples
