// SPDX-License-Identifier: MIT
#include "palpation_sensing.hpp"

#include <cmath>

namespace limpid::examples {

ClockedSensor::ClockedSensor(const Scene& scene)
    : sensor_{scene.disturbances.sensing, scene.disturbances.seed}, period_{scene.period}, tick_{scene.tick} {
  draw_next();
}

std::optional<SensedTool> ClockedSensor::sample(Time now, const SensedTool& truly) {
  std::optional<SensedTool> sample;
  for (; due_ <= now; draw_next()) {
    if (!sensor_.lost()) sample = sensor_.sense(truly);
  }
  return sample;
}

void ClockedSensor::draw_next() {
  sensor_.draw();
  const Duration::rep on_time = (next_++ * period_ + tick_ - Duration{1}) / tick_;
  due_ = tick_ * (on_time + std::llround(sensor_.off(in_seconds(period_) / in_seconds(tick_))));
}

}  // namespace limpid::examples
