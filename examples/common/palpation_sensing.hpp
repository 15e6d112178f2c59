// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <limpid/environment/tool.hpp>
#include <limpid/loop/signal.hpp>
#include <limpid/scene/palpation_signals.hpp>
#include <limpid/signal/delayed_sampled.hpp>
#include <limpid/signal/sample.hpp>

#include <memory>
#include <optional>

namespace limpid::examples {

/// A sensor with a clock: each sample at the first tick at or after its instant, or as many ticks off as it draws.
class ClockedSensor {
 public:
  explicit ClockedSensor(const Scene& scene);

  /// What is sampled at `now`, where anything is; called each tick.
  [[nodiscard]] std::optional<SensedTool> sample(Time now, const SensedTool& truly);

 private:
  void draw_next();

  Sensor sensor_;
  Duration period_, tick_;
  Duration::rep next_ = 0;  // its number
  Time due_{};
};

/// The slow environment: that of a live run; or as if it ran elsewhere, palpation::SamplingBlock, or with a disturbed
/// sensor.
template <int Axes>
struct SensingBlock {
  using reads = signals<palpation::TrueTool<Axes>>;
  using writes = signals<palpation::SeenTool<Axes>>;

  DelayedSampled<ToolState<Axes>> component;
  Duration delay;
  std::optional<ClockedSensor> sensor;
  std::shared_ptr<const RemoteTissue> remote;

  explicit SensingBlock(const Scene& scene)
      : component({.period = scene.period, .delay = scene.delay}), delay{scene.delay}, remote{scene.remote} {
    if (scene.disturbances.sensing.any()) sensor.emplace(scene);
  }

  const Held<ToolState<Axes>>& operator()(Time now, const ToolState<Axes>& tool) noexcept {
    if constexpr (Axes == 1) {
      if (remote) return remote->seen;
    }
    if (!sensor) return component.update(now, tool);
    if (const auto sensed = sensor->sample(now, {tool.x[0], tool.v[0], tool.force[0]})) {
      Sample<ToolState<Axes>> sample{tool, now, now + delay};
      sample.value.x[0] = sensed->x;
      sample.value.v[0] = sensed->v;
      sample.value.force[0] = sensed->F_e;
      (void)component.offer(sample);
    }
    return component.update(now);
  }
};

}  // namespace limpid::examples
