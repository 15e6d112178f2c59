// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/robot/omni.hpp>

#include <array>
#include <vector>

namespace limpid::examples {

/// A joint whose tip pushes on a force sensor, at one instant of a slow ramp.
struct RampSample {
  double command;   ///< torque command of (5.5), N m
  double measured;  ///< torque at the joint that the sensor's force comes to, N m
  bool rising;      ///< whether the command rises
};

/// What the hysteresis loop of a joint tells, sections 5.2.4 to 5.2.6.
struct RampResult {
  double conversion = 0;  ///< N m of torque for one of command, of (5.5)
  double limit = 0;       ///< the torque beyond which the motor gives no more, N m; NaN where it was not reached
  double friction = 0;    ///< static friction, N m
  double offset = 0;      ///< measured torque without command or friction: the weight of the arm, negative, N m
};

/// The command goes to its largest, to minus that, and back. Where the joint slides, measured torque is
///
///     conversion command + offset -+ friction
///
/// less of it where it pushes harder, more where it gives way. One regression over both sides, with a slope of both and
/// an intercept of each, gives the first three; half of the distance between the flat ends and the friction is the
/// limit.
/// @throws std::invalid_argument  where the samples are no such loop
[[nodiscard]] RampResult evaluate_ramp(const std::vector<RampSample>& samples);

/// A force sensor's ramps on the realistic simulated arm: a spring holds the tip at its place at the start.
struct SimulatedRamp {
  double amplitude = 0.4;   ///< of the command, N m, > 0
  double rate = 0.04;       ///< N m/s, > 0
  double stiffness = 1000;  ///< of the sensor, a dome of rubber, N/m, > 0
  double damping = 20;      ///< of the same, N s/m, >= 0; with none it quivers, which shakes the friction loose
};

/// @param joint  that gets the command, 0 to 2; the others have none
[[nodiscard]] std::vector<RampSample> simulate_ramp(int joint, const SimulatedRamp& ramp = {});

}  // namespace limpid::examples
