// SPDX-License-Identifier: MIT
#pragma once

#include "tick/library_tick.hpp"

#include <limpid/evaluation/latency_histogram.hpp>

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace limpid::bench {

/// A scene's whole tick, from the sampled tool to the torque that the device may have, with its own clock.
class Scene {
 public:
  template <int Axes, typename Loop>
  static Scene of(std::string name, Loop loop, bool touching) {
    Scene scene;
    scene.name_ = std::move(name);
    scene.bytes_ = sizeof(Loop);
    scene.run_ = [loop = std::move(loop), inputs = inputs_of<Axes>(touching), now = Time{0}, next = std::size_t{0}](
                     long ticks, LatencyHistogram* histogram) mutable {
      for (long i = 0; i < ticks; ++i, now += std::chrono::milliseconds{1}, next = (next + 1) % inputs.size()) {
        const Input<Axes>& in = inputs[next];
        if (histogram == nullptr) {
          benchmark::DoNotOptimize(loop.step(now, in.F_h, in.F_h, in.tool, in.device));
          continue;
        }
        const auto start = std::chrono::steady_clock::now();
        benchmark::DoNotOptimize(loop.step(now, in.F_h, in.F_h, in.tool, in.device));
        histogram->add(std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now() - start));
      }
    };
    return scene;
  }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  void run(long ticks, LatencyHistogram* histogram = nullptr) { run_(ticks, histogram); }

 private:
  template <int Axes>
  struct Input {
    Eigen::Vector3d F_h;
    ToolState<Axes> tool;
    DeviceState<3> device;
  };

  // The press of `tick_inputs`; without contact the tool moves a centimetre before the wall.
  template <int Axes>
  static std::vector<Input<Axes>> inputs_of(bool touching) {
    std::vector<Input<Axes>> inputs;
    for (const TickInput<double>& of : tick_inputs<double>()) {
      Input<Axes> in{
          of.F_h,
          {of.tool.x.head<Axes>(), of.tool.v.head<Axes>(), of.tool.a.head<Axes>(), of.tool.force.head<Axes>()},
          of.device};
      if (!touching) {
        in.F_h -= of.tool.force.matrix();
        in.tool.x -= 0.01;
        in.tool.force.setZero();
      }
      inputs.push_back(in);
    }
    return inputs;
  }

  std::string name_;
  std::size_t bytes_ = 0;
  std::function<void(long, LatencyHistogram*)> run_;
};

/// The loop of a scene: these blocks, which predict, with a sample every `period`, as much late.
template <int Axes, typename... Blocks>
[[nodiscard]] auto scene_loop(Duration period, Blocks... blocks) {
  using namespace palpation;
  using Arm = Omni<>;
  const TickParts<double> parts;
  return make_loop<wants<AllowedTorque<Arm>>,
                   inputs<OperatorForce<>, ForceOnArm<>, TrueTool<Axes>, MeasuredState<Arm>>>(
      std::move(blocks)..., SamplingBlock<Axes>{DelayedSampled<ToolState<Axes>>({.period = period, .delay = period})},
      KinematicsBlock<OmniKinematics<>, Arm, Axes>{parts.kinematics, parts.wall},
      TrackingBlock<SlotineLiAdaptive<Arm>, Arm>{parts.controller}, SafetyBlock<Arm>{parts.limiter});
}

// One source each: compiled side by side.
void add_held_scenes(std::vector<Scene>& scenes);
void add_known_scenes(std::vector<Scene>& scenes);
void add_nonlinear_scenes(std::vector<Scene>& scenes);
void add_estimated_scenes(std::vector<Scene>& scenes);

[[nodiscard]] inline std::vector<Scene> all_scenes() {
  std::vector<Scene> scenes;
  add_held_scenes(scenes);
  add_known_scenes(scenes);
  add_nonlinear_scenes(scenes);
  add_estimated_scenes(scenes);
  return scenes;
}

}  // namespace limpid::bench
