// SPDX-License-Identifier: MIT
// The run of one loop over one scene, for any set of blocks; included by the sources that compose loops.
#pragma once

#include "palpation_operator.hpp"
#include "scene.hpp"

#include <limpid/control/omni_safety.hpp>
#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/device/simulated_omni.hpp>
#include <limpid/environment/kelvin_voigt.hpp>
#include <limpid/environment/virtual_tool.hpp>
#include <limpid/loop/loop.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>
#include <limpid/scene/palpation_blocks.hpp>

#include <chrono>
#include <functional>
#include <utility>

namespace limpid::examples {

using ProgressCallback = std::function<void(double)>;

/// The tissue as it truly is, whatever its type: moves the tool to `now` under the force at `now`, N.
using Plant = std::function<ToolState<3>(Time now, double force)>;

[[nodiscard]] Plant make_plant(const Scene& scene);

/// The wall's origin in the base frame: where the tip starts, m.
[[nodiscard]] Eigen::Vector3d wall_of(const Scene& scene);

/// The tool as the predictor knows it.
template <int Axes>
[[nodiscard]] Tool<Axes> tool_of(const Scene& scene) {
  Tool<Axes> tool{.mass = scene.tool.mass, .damping = scene.tool.damping, .stiffness = scene.tool.stiffness};
  if (scene.spring_at_base) tool.anchor = -wall_of(scene).template head<Axes>().array();
  return tool;
}

[[nodiscard]] SimulatedOmni<> make_device(const Scene& scene);
[[nodiscard]] SlotineLiAdaptive<Omni<>> make_controller(const Scene& scene);
[[nodiscard]] SafetyLimiter<Omni<>> make_limiter(const Scene& scene);

/// The scene's tool along the axes that a loop works with.
template <int Axes>
[[nodiscard]] ToolState<Axes> along(const ToolState<3>& tool) {
  return {tool.x.head<Axes>(), tool.v.head<Axes>(), tool.a.head<Axes>(), tool.force.head<Axes>()};
}

/// What is left of the status once the wait for the first sample is explained.
[[nodiscard]] inline Status beyond_waiting(Status status) {
  return static_cast<Status>(static_cast<std::uint32_t>(status) & ~static_cast<std::uint32_t>(Status::no_sample));
}

/// A loop of the scene's blocks around the blocks that predict.
template <int Axes, typename... PredictionBlocks>
[[nodiscard]] auto compose(const Scene& scene, PredictionBlocks... prediction) {
  using namespace palpation;
  using Arm = Omni<>;
  return make_loop<wants<AllowedTorque<Arm>, PredictedMotion<Axes>>,
                   inputs<OperatorForce<>, ForceOnArm<>, TrueTool<Axes>, MeasuredState<Arm>>>(
      SamplingBlock<Axes>{DelayedSampled<ToolState<Axes>>({.period = scene.period, .delay = scene.delay})},
      std::move(prediction)..., KinematicsBlock<OmniKinematics<>, Arm, Axes>{OmniKinematics<>(Arm{}), wall_of(scene)},
      TrackingBlock<SlotineLiAdaptive<Arm>, Arm>{make_controller(scene)}, SafetyBlock<Arm>{make_limiter(scene)});
}

/// Ticks through the scene.
/// @param parameters  what the loop has estimated, for the trace
template <int Axes, typename Loop, typename Parameters>
[[nodiscard]] PalpationResult run(const Scene& scene, Loop loop, Parameters&& parameters,
                                  const ProgressCallback& progress) {
  using namespace palpation;
  PalpationResult result;
  const Plant plant = make_plant(scene);
  const Eigen::Vector3d wall = wall_of(scene);
  const Omni<> arm;
  SimulatedOmni<> device = make_device(scene);
  PalpationOperator person(scene, wall[0]);
  const Duration::rep ticks = scene.duration / scene.tick;
  result.trace.reserve(static_cast<std::size_t>(ticks + 1));
  for (Duration::rep k = 0; k <= ticks; ++k) {
    const Time now = k * scene.tick;
    const double F_h = person.press(now, device);
    const Eigen::Vector3d hand{F_h, 0, 0}, on_arm{scene.playback ? 0 : F_h, 0, 0};
    const ToolState<3> tool = plant(now, F_h);
    result.status |= person.status() | device.advance(now, hand);
    const DeviceState<> measured = device.read(now);

    const auto started = std::chrono::steady_clock::now();
    const auto [torque, predicted, status] = loop.step(now, hand, on_arm, along<Axes>(tool), measured);
    const auto ended = std::chrono::steady_clock::now();

    result.tick.add(std::chrono::duration_cast<std::chrono::nanoseconds>(ended - started));
    result.status |= beyond_waiting(status);
    result.status |= device.write(torque);

    Motion<3> motion;
    motion.x.template head<Axes>() = predicted.motion.x;
    motion.v.template head<Axes>() = predicted.motion.v;
    const auto truth = device.true_state();
    const auto pose = arm.at(truth.q);
    const Eigen::Array3d tip = (pose.position() - wall).array();
    const Eigen::Array3d tip_velocity = (pose.jacobian() * truth.qdot).array();
    const Eigen::Array3d ep = motion.x - tool.x, ev = motion.v - tool.v, et = tip - tool.x, etv = tip_velocity - tool.v;
    (void)result.prediction.add(now, ep, ev);
    (void)result.total.add(now, et, etv);
    result.trace.push_back({in_seconds(now), scene.force.at(now), F_h, tool.x[0], motion.x[0], tip[0],
                            std::sqrt((ep * ep + ev * ev).sum()), std::sqrt((et * et + etv * etv).sum()),
                            parameters(loop), torque.value()});
    if (progress && k % 256 == 0) progress(static_cast<double>(k) / static_cast<double>(ticks));
  }
  result.energy = person.energy();
  return result;
}

}  // namespace limpid::examples
