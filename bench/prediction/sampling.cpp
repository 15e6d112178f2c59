// SPDX-License-Identifier: MIT
#include "prediction/sampling.hpp"

#include <algorithm>
#include <cmath>

namespace limpid::bench {

std::vector<SensedSample> sampled(const Truth& truth, std::size_t period, const Sensing& sensing, std::uint32_t seed) {
  examples::Sensor sensor(sensing, seed);
  std::vector<SensedSample> samples;
  for (std::size_t k = 0;; ++k) {
    sensor.draw();
    const double instant = static_cast<double>(k * period) + sensor.off(static_cast<double>(period));
    const auto taken = static_cast<std::size_t>(std::llround(instant));
    if (taken >= truth.ticks.size()) break;
    if (sensor.lost()) continue;
    const TrueTick& tick = truth.ticks[taken];
    const auto [x, v, F_e] = sensor.sense({tick.tool.x, tick.tool.v, tick.F_e});
    samples.push_back({taken, taken + period, x, v, F_e});
  }
  std::ranges::sort(samples, {}, &SensedSample::taken);
  return samples;
}

// FNV-1a.
std::uint32_t seed_of(const std::string& name) {
  std::uint32_t hash = 2166136261;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash;
}

}  // namespace limpid::bench
