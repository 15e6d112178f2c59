// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/premise.hpp"
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
  /// @tparam Predicting  the loop's block that predicts
  template <typename Predicting, int Axes, typename Loop>
  static Scene of(std::string name, const Premise& premise, Loop loop, std::vector<TickInput<Axes>> inputs) {
    Scene scene;
    scene.name_ = std::move(name);
    scene.bytes_ = sizeof(Loop);
    scene.run_ = [loop, inputs, now = Time{0}, next = std::size_t{0}](long ticks, LatencyHistogram* histogram) mutable {
      for (long i = 0; i < ticks; ++i, now += std::chrono::milliseconds{1}, next = (next + 1) % inputs.size()) {
        const TickInput<Axes>& in = inputs[next];
        if (histogram == nullptr) {
          benchmark::DoNotOptimize(loop.step(now, in.F_h, in.F_h, in.tool, in.device));
          continue;
        }
        const auto start = std::chrono::steady_clock::now();
        benchmark::DoNotOptimize(loop.step(now, in.F_h, in.F_h, in.tool, in.device));
        histogram->add(std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now() - start));
      }
    };
    scene.broken_premise_ = [premise, loop, inputs]() mutable {
      constexpr int settling = 2048, ticks = 4096;
      Survey survey(premise);
      for (int i = 0; i < settling + ticks; ++i) {
        const TickInput<Axes>& in = inputs[static_cast<std::size_t>(i) % inputs.size()];
        const Time now = i * Time{std::chrono::milliseconds{1}};
        const Status status = loop.step(now, in.F_h, in.F_h, in.tool, in.device).status;
        if (i < settling) continue;
        // A second call at the same time changes nothing, and says where the tool was predicted.
        const auto again =
            loop.template block<Predicting>().component.advance(now, in.F_h.template head<Axes>().array());
        survey.see(again.motion.x[0], in.tool.x[0], status);
      }
      return survey.broken();
    };
    return scene;
  }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  void run(long ticks, LatencyHistogram* histogram = nullptr) { run_(ticks, histogram); }

  /// What of the scene's premise does not hold, in a run of its own; empty where all does.
  [[nodiscard]] std::string broken_premise() { return broken_premise_(); }

 private:
  std::string name_;
  std::size_t bytes_ = 0;
  std::function<void(long, LatencyHistogram*)> run_;
  std::function<std::string()> broken_premise_;
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

/// Whether the premises of all hold; says which do not.
[[nodiscard]] bool premises_hold(std::vector<Scene>& scenes);

}  // namespace limpid::bench
