// SPDX-License-Identifier: MIT
// One loop over one scene, for any set of blocks; included by the sources that compose loops.
#pragma once

#include "palpation_arm.hpp"
#include "palpation_sensing.hpp"
#include "scene.hpp"

#include <limpid/control/slotine_li_adaptive.hpp>
#include <limpid/loop/loop.hpp>
#include <limpid/robot/omni.hpp>
#include <limpid/robot/omni_kinematics.hpp>
#include <limpid/scene/palpation_blocks.hpp>

#include <chrono>
#include <functional>
#include <memory>
#include <utility>

namespace limpid::examples {

/// The tissue as it truly is, whatever its type: moves the tool to `now` under the force at `now`, N.
using Plant = std::function<ToolState<3>(Time now, double force)>;

[[nodiscard]] Plant make_plant(const Scene& scene);

/// The tool as the predictor knows it.
template <int Axes>
[[nodiscard]] Tool<Axes> tool_of(const Scene& scene) {
  Tool<Axes> tool{.mass = scene.tool.mass, .damping = scene.tool.damping, .stiffness = scene.tool.stiffness};
  if (scene.spring_at_base) tool.anchor = -wall_of(scene).template head<Axes>().array();
  return tool;
}

/// The scene's tool along the axes that a loop works with.
template <int Axes>
[[nodiscard]] ToolState<Axes> along(const ToolState<3>& tool) {
  return {tool.x.head<Axes>(), tool.v.head<Axes>(), tool.a.head<Axes>(), tool.force.head<Axes>()};
}

/// The controller; where a tissue that runs elsewhere has fallen silent, only what holds the arm against gravity.
struct FadingTrackingBlock : palpation::TrackingBlock<SlotineLiAdaptive<Omni<>>, Omni<>> {
  using Block = palpation::TrackingBlock<SlotineLiAdaptive<Omni<>>, Omni<>>;

  std::shared_ptr<const RemoteTissue> remote;

  explicit FadingTrackingBlock(const Scene& scene)
      : Block{SlotineLiAdaptive<Omni<>>(controller_settings(scene))}, remote{scene.remote} {}

  Reported<Eigen::Vector3d> operator()(Time now, const DeviceState<>& measured, const InverseMotion<3>& desired,
                                       const Eigen::Vector3d& F_h, const SafeTorque<3>& applied) noexcept {
    auto wanted = Block::operator()(now, measured, desired, F_h, applied);
    if (!remote || remote->factor >= 1) return wanted;
    const Eigen::Vector3d weight = Omni<>{}.at(measured.q).tau_g(component.theta_hat());
    wanted.value = weight + remote->factor * (wanted.value - weight);
    return wanted;
  }
};

/// A loop of the scene's blocks around the blocks that predict.
template <int Axes, typename... PredictionBlocks>
[[nodiscard]] auto compose(const Scene& scene, PredictionBlocks... prediction) {
  using namespace palpation;
  using Arm = Omni<>;
  return make_loop<wants<AllowedTorque<Arm>, PredictedMotion<Axes>>,
                   inputs<OperatorForce<>, ForceOnArm<>, TrueTool<Axes>, MeasuredState<Arm>>>(
      SensingBlock<Axes>(scene), std::move(prediction)...,
      KinematicsBlock<OmniKinematics<>, Arm, Axes>{OmniKinematics<>(Arm{}), wall_of(scene)}, FadingTrackingBlock(scene),
      SafetyBlock<Arm>{make_limiter(scene)});
}

/// What a loop makes of a tick.
struct LoopTick {
  SafeTorque<3> torque;
  Motion<3> motion;           ///< predicted; at rest along axes that the loop does not work with
  Eigen::Array2d parameters;  ///< estimated, for the trace
  Status status;
  std::chrono::nanoseconds work;  ///< of the loop alone
};

/// A loop of any blocks: a tick from the hand's force, what of it the arm feels, the true tool and the measured state.
using LoopStep = std::function<LoopTick(Time now, const Eigen::Vector3d& hand, const Eigen::Vector3d& on_arm,
                                        const ToolState<3>& tool, const DeviceState<>& measured)>;

/// Ticks through the scene.
[[nodiscard]] PalpationResult run(const Scene& scene, const LoopStep& step, const ProgressCallback& progress);

/// @param parameters  what the loop has estimated, for the trace
template <int Axes, typename Loop, typename Parameters>
[[nodiscard]] PalpationResult run(const Scene& scene, Loop loop, const Parameters& parameters,
                                  const ProgressCallback& progress) {
  const auto step = [loop = std::move(loop), parameters](Time now, const Eigen::Vector3d& hand,
                                                         const Eigen::Vector3d& on_arm, const ToolState<3>& tool,
                                                         const DeviceState<>& measured) mutable -> LoopTick {
    const ToolState<Axes> seen = along<Axes>(tool);
    const auto started = std::chrono::steady_clock::now();
    const auto [torque, predicted, status] = loop.step(now, hand, on_arm, seen, measured);
    const auto ended = std::chrono::steady_clock::now();
    Motion<3> motion;
    motion.x.template head<Axes>() = predicted.motion.x;
    motion.v.template head<Axes>() = predicted.motion.v;
    return {torque, motion, parameters(loop), status, ended - started};
  };
  return run(scene, LoopStep(step), progress);
}

}  // namespace limpid::examples
